# %% name="the image comes back, not its name" sentence="You return the image after itself; the task asks for the name of the operation, as text." must_say=["return|back|came", "image|array", "name|text|string|\\bstr\\b", "text|string|\\bstr\\b|itself"] kind="type"
def name_operation(before, after):
    if after.ndim == 3:
        return after
    return "grayscale"
