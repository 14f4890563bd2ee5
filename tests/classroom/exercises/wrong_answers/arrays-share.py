# %% name="a text with percent sign" sentence="You return a text: return the number itself, without the percent sign." must_say=["text|string|str", "number|float|without"] kind="type"
def bright_percent(gray, level):
    return f"{(gray > level).mean() * 100}%"
