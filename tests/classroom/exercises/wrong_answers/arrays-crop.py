# %% name="top:left for top:bottom" sentence="A slice goes from top to bottom: image[top:bottom, left:right]." must_say=["slice|top"] must_not_say=["border", "pad the image"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:left, bottom:right]

# %% name="commas instead of colons" sentence="With commas you index four axes, and an image has two or three: a slice has a colon, top:bottom." must_say=["colon|:", "slice|too many ind|axes|dimension|indices"] kind="error"
def crop(image, top, bottom, left, right):
    return image[top, bottom, left, right]

# %% name="return forgotten" sentence="You cut the image but never give it back: end the function with return." must_say=["return"] kind="no-return"
def crop(image, top, bottom, left, right):
    part = image[top:bottom, left:right]

# %% name="both ranges in one bracket each" sentence="The second slice takes rows again: write both slices in one pair of brackets." must_say=["one pair of brackets|comma|rows again|image\\[top:bottom, left:right\\]"] kind="shape"
def crop(image, top, bottom, left, right):
    return image[top:bottom][left:right]

# %% name="Syntax error" sentence="Syntax error: the closing square bracket is missing." must_say=["bracket|never closed|error"] kind="syntax"
def crop(image, top, bottom, left, right):
    return image[top:bottom, left:right
