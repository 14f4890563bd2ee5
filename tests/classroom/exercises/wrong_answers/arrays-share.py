# %% name="count instead of percent" origin="new" sentence="You count the pixels: divide by their number and multiply by 100, or take mean() * 100." must_say=["count|number of pixels|sum", "mean|percent|divid|100|share"] kind="value"
def bright_percent(gray, level):
    return (gray > level).sum()

# %% name="share between 0 and 1" origin="new" sentence="This is the share, from 0 to 1: multiply it by 100 to get percent." must_say=["100|percent", "share|multipl|0 to 1|times|fraction|\\* ?100"] kind="value"
def bright_percent(gray, level):
    return (gray > level).mean()

# %% name="at least instead of more than" origin="new" sentence="A pixel that is equal to level is not brighter: use > instead of >=." must_say=[">=|equal|at least", ">|brighter|not count|strict"] kind="value"
def bright_percent(gray, level):
    return (gray >= level).mean() * 100

# %% name="dark instead of bright" origin="new" sentence="You count the darker pixels: turn the comparison around, gray > level." must_say=["dark|less|<|below|turn|other (side|direction)|opposite|wrong way", ">|bright|compar|percent|turn"] kind="value"
def bright_percent(gray, level):
    return (gray < level).mean() * 100

# %% name="mean of the bright values" origin="new" sentence="gray[gray > level] selects gray levels, and you take their mean: take the mean of the mask itself." must_say=["mean|select|gray levels?|values", "mask|share|> ?level|bright"] kind="value"
def bright_percent(gray, level):
    return gray[gray > level].mean()

# %% name="if with an array" origin="new" sentence="if needs one truth value, and gray > level has one for each pixel: take the mean of the mask." must_say=["truth|if |each pixel|one for each|ambiguous", "mask|mean|any|all|pixel|element|one"] kind="error"
def bright_percent(gray, level):
    if gray > level:
        return 100.0
    return 0.0

# %% name="divided by the rows" origin="new" sentence="You divide by the number of rows only: divide by all pixels, gray.size." must_say=["rows?|len", "size|all pixels|rows times|pixels|columns"] kind="value"
def bright_percent(gray, level):
    return (gray > level).sum() / len(gray) * 100

# %% name="integer division" origin="new" sentence="// cuts the fraction, so the share is 0: divide with /." must_say=["//|whole|integer|fraction|cut", "/|divi|share|fraction|0"] kind="value"
def bright_percent(gray, level):
    return (gray > level).sum() // gray.size * 100

# %% name="fixed level" origin="new" sentence="128 is fixed: compare with the parameter level." must_say=["128|fixed|parameter|argument|level", "level|parameter"] kind="value"
def bright_percent(gray, level):
    return (gray > 128).mean() * 100

# %% name="a text with percent sign" origin="new" sentence="You return a text: return the number itself, without the percent sign." must_say=["text|string|str", "number|float|without"] kind="type"
def bright_percent(gray, level):
    return f"{(gray > level).mean() * 100}%"

# %% name="printed" origin="new" sentence="Your function prints the number but returns nothing: give it back with return." must_say=["return", "print"] kind="no-return"
def bright_percent(gray, level):
    print((gray > level).mean() * 100)
