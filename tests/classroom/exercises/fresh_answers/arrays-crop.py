# %% name="width and height as size" origin="fresh" sentence="bottom and right are places in the image, not sizes: the slice ends at bottom, so do not add top." must_say=["top|bottom|left|right|stop|end|size|slice"] must_not_say=["order of the|swap|columns? first|rows? (come|stand) first"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:top + bottom, left:left + right]

# %% name="starts one pixel late" origin="fresh" sentence="The first row is row top itself and the first column is left: you start one row and one column too late." must_say=["start|begin|first|\\+ ?1|one"] must_not_say=["stop of a slice is (not|already)|last row"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top + 1:bottom, left + 1:right]

# %% name="one pair of brackets each" origin="fresh" sentence="The second pair of brackets cuts rows again: write both slices in one pair, image[top:bottom, left:right]." must_say=["comma|one pair|brackets|rows again|\\[top:bottom, ?left:right\\]"] kind="shape"
def crop(image, top, bottom, left, right):
    part = image[top:bottom]
    part = part[left:right]
    return part

# %% name="tiny instead of image" origin="fresh" sentence="You use tiny, the image of the lesson, instead of the given image." must_say=["tiny|given image|argument|image of the lesson|parameter"] kind="value"
def crop(image, top, bottom, left, right):
    both = tiny[top:bottom, left:right]
    return both

# %% name="blackens the rest" origin="fresh" sentence="You keep the size of the image and make the rest black; the result has only the rows and columns of the rectangle." must_say=["shape|size|slice|only|smaller"] must_not_say=["transpos"] kind="shape"
def crop(image, top, bottom, left, right):
    result = np.zeros_like(image)
    result[top:bottom, left:right] = image[top:bottom, left:right]
    return result
