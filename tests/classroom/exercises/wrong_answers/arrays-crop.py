# %% name="top:left for top:bottom" sentence="A slice goes from top to bottom: image[top:bottom, left:right]." must_say=["slice|top"] must_not_say=["border", "pad the image"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:left, bottom:right]

# %% name="Syntax error" sentence="Syntax error: the closing square bracket is missing." must_say=["bracket|never closed|error"] kind="syntax"
def crop(image, top, bottom, left, right):
    return image[top:bottom, left:right
