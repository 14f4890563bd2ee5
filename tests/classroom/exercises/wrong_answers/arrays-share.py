# %% name="printed" sentence="Your function prints the number but returns nothing: give it back with return." must_say=["return", "print"] kind="no-return"
def bright_percent(gray, level):
    print((gray > level).mean() * 100)

# %% name="a text with percent sign" sentence="You return a text: return the number itself, without the percent sign." must_say=["text|string|str", "number|float|without"] kind="type"
def bright_percent(gray, level):
    return f"{(gray > level).mean() * 100}%"

# %% name="if with an array" sentence="if needs one truth value, and gray > level has one for each pixel: take the mean of the mask." must_say=["truth|if |each pixel|one for each|ambiguous", "mask|mean|any|all|pixel|element|one"] kind="error"
def bright_percent(gray, level):
    if gray > level:
        return 100.0
    return 0.0
