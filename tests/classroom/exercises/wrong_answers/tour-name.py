# %% name="whole array in an if" sentence="after == 255 is one True or False for each pixel, and if needs a single one: ask with .any(), .all() or compare .mean() with a number." must_say=["array|each pixel|many|one for", "any|all|mean"] kind="error"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if after == 255:
        return "binarization"
    return "grayscale"

# %% name="single = in the if" sentence="Python cannot read this: = stores a value, and a comparison needs ==." must_say=["==", "stores|assign|syntax|Python cannot|needs =="] kind="syntax"
def name_operation(before, after):
    if after.ndim = 3:
        return "noise removal"
    return "grayscale"

# %% name="the image comes back, not its name" sentence="You return the image after itself; the task asks for the name of the operation, as text." must_say=["return|back|came", "image|array", "name|text|string|\\bstr\\b", "text|string|\\bstr\\b|itself"] kind="type"
def name_operation(before, after):
    if after.ndim == 3:
        return after
    return "grayscale"
