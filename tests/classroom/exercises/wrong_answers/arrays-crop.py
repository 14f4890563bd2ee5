# %% name="columns first" origin="new" sentence="Rows come first: the first index is for rows (top:bottom), the second for columns (left:right)." must_say=["rows?", "first|order|swap|before"] kind="value"
def crop(image, top, bottom, left, right):
    return image[left:right, top:bottom]

# %% name="last row and column included" origin="new" sentence="The stop of a slice is not included, so bottom + 1 takes one row too many: write top:bottom." must_say=["stop|not included|exclu|one (row|more)|too many|\\+ ?1", "bottom|row|slice"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom + 1, left:right + 1]

# %% name="last row and column lost" origin="new" sentence="The stop of a slice is already excluded, so bottom - 1 loses one more row and column: write top:bottom." must_say=["stop|exclu|one (row|more)|los|too few|missing|- ?1", "bottom|row|slice"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom - 1, left:right - 1]

# %% name="two pairs of brackets" origin="new" sentence="image[top:bottom][left:right] cuts the rows twice: write both slices in one pair of brackets, with a comma." must_say=["rows? (is |are )?twice|both slices|one pair|comma|twice", "bracket|comma|\\[top:bottom, left:right\\]"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom][left:right]

# %% name="rows only" origin="new" sentence="You cut the rows but keep every column: add the second slice after a comma, left:right." must_say=["column", "left:right|second (slice|index)|comma|keep|all|every|not cut"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom]

# %% name="columns only" origin="new" sentence="You cut the columns but keep every row: the first slice must be top:bottom." must_say=["rows?", "top:bottom|first (slice|index)|keep|all|every|not cut"] kind="value"
def crop(image, top, bottom, left, right):
    return image[:, left:right]

# %% name="commas instead of colons" origin="new" sentence="With commas you index four axes, and an image has two or three: a slice has a colon, top:bottom." must_say=["colon|:", "slice|too many ind|axes|dimension|indices"] kind="error"
def crop(image, top, bottom, left, right):
    return image[top, bottom, left, right]

# %% name="return forgotten" origin="new" sentence="You cut the image but never give it back: end the function with return." must_say=["return"] kind="no-return"
def crop(image, top, bottom, left, right):
    part = image[top:bottom, left:right]

# %% name="heights instead of ends" origin="new" sentence="A slice ends at a position, not after a length: write top:bottom, not top:bottom - top." must_say=["stop|end|position|length|number of|bottom - top|height", "top:bottom|slice|index|row"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom - top, left:right - left]

# %% name="fixed numbers" origin="new" sentence="The numbers 1:4 and 2:5 are right for one example only: use the parameters top, bottom, left and right." must_say=["fixed|example|constant|numbers?|parameters?|argument", "top|parameter|argument|bottom"] kind="value"
def crop(image, top, bottom, left, right):
    return image[1:4, 2:5]

# %% name="the rest is black" origin="new" sentence="You keep the full size and only set the rest to 0: return only the part, with its smaller shape." must_say=["shape|size|smaller|part", "full|same|whole|size|shape"] kind="shape"
def crop(image, top, bottom, left, right):
    result = np.zeros_like(image)
    result[top:bottom, left:right] = image[top:bottom, left:right]
    return result

# %% name="no parameter for the numbers" origin="new" sentence="The function is called with five arguments, the image and four numbers: write crop(image, top, bottom, left, right)." must_say=["argument|parameter", "five|5|takes|top|four"] kind="error"
def crop(image):
    return image[1:4, 2:5]

# %% name="top:left for top:bottom" origin="walk" sentence="A slice goes from top to bottom: image[top:bottom, left:right]." must_say=["slice|top"] must_not_say=["border", "pad the image"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:left, bottom:right]
