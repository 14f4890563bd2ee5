# %% name="last row and column included" origin="new" sentence="The stop of a slice is not included, so bottom + 1 takes one row too many: write top:bottom." must_say=["stop|not included|exclu|one (row|more)|too many|\\+ ?1", "bottom|row|slice"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom + 1, left:right + 1]

# %% name="last row and column lost" origin="new" sentence="The stop of a slice is already excluded, so bottom - 1 loses one more row and column: write top:bottom." must_say=["stop|exclu|one (row|more)|los|too few|missing|- ?1", "bottom|row|slice"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom - 1, left:right - 1]

# %% name="commas instead of colons" origin="new" sentence="With commas you index four axes, and an image has two or three: a slice has a colon, top:bottom." must_say=["colon|:", "slice|too many ind|axes|dimension|indices"] kind="error"
def crop(image, top, bottom, left, right):
    return image[top, bottom, left, right]

# %% name="return forgotten" origin="new" sentence="You cut the image but never give it back: end the function with return." must_say=["return"] kind="no-return"
def crop(image, top, bottom, left, right):
    part = image[top:bottom, left:right]

# %% name="heights instead of ends" origin="new" sentence="A slice ends at a position, not after a length: write top:bottom, not top:bottom - top." must_say=["stop|end|position|length|number of|bottom - top|height", "top:bottom|slice|index|row"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom - top, left:right - left]

# %% name="no parameter for the numbers" origin="new" sentence="The function is called with five arguments, the image and four numbers: write crop(image, top, bottom, left, right)." must_say=["argument|parameter", "five|5|takes|top|four"] kind="error"
def crop(image):
    return image[1:4, 2:5]

# %% name="top:left for top:bottom" origin="walk" sentence="A slice goes from top to bottom: image[top:bottom, left:right]." must_say=["slice|top"] must_not_say=["border", "pad the image"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:left, bottom:right]
