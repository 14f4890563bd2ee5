# %% name="rows reversed" origin="new" sentence="You reverse the rows, so top and bottom are exchanged: leave the rows (:) and reverse the columns with ::-1." must_say=["rows?|top|bottom|upside", "column|second|, ?::-1|left"] kind="value"
def mirror(image):
    return image[::-1]

# %% name="both reversed" origin="new" sentence="You reverse rows and columns, which turns the image by 180 degrees: leave the rows as they are with a single colon." must_say=["rows?|180|turn|rotat|both", "column|rows?|:"] kind="value"
def mirror(image):
    return image[::-1, ::-1]

# %% name="channels reversed" origin="new" sentence="... ::-1 reverses the last axis, which holds the channels of a colour image: the columns are the second axis, [:, ::-1]." must_say=["channel|last axis", "second|column|\\[:, ::-1\\]|axis 1"] kind="value"
def mirror(image):
    return image[..., ::-1]

# %% name="stop at -1" origin="new" sentence="0:-1:-1 is empty, because -1 means the last column: leave start and stop out, ::-1." must_say=["empty|no column|nothing|width 0|0 columns|last", "::-1|leave|start|stop|out"] kind="shape"
def mirror(image):
    return image[:, 0:-1:-1]

# %% name="last column lost" origin="new" sentence="-2 starts at the last column but one: leave the start out, ::-1." must_say=["last|one column|los|missing|too few", "::-1|start|column"] kind="shape"
def mirror(image):
    return image[:, -2::-1]

# %% name="reversed in place by a loop" origin="new" sentence="You change the given image, and then the first half is already overwritten when the second half needs it: work on a copy, or use a slice." must_say=["copy|chang", "image|input"] kind="input-changed"
def mirror(image):
    width = image.shape[1]
    for column in range(width):
        image[:, column] = image[:, width - 1 - column]
    return image

# %% name="half overwritten on a copy" origin="new" sentence="You read columns that you have already overwritten: read from image and write to the copy." must_say=["read|overwritten|half|mirror image of|symmetr|already|changed", "copy|image|column"] kind="value"
def mirror(image):
    result = image.copy()
    width = image.shape[1]
    for column in range(width):
        result[:, column] = result[:, width - 1 - column]
    return result

# %% name="index without minus 1" origin="new" sentence="The last column is width - 1, because the index starts at 0: width - column is one too far." must_say=["width - 1|from 0|last|out of|- ?1|one too", "index|column|range|bounds"] kind="error"
def mirror(image):
    result = image.copy()
    width = image.shape[1]
    for column in range(width):
        result[:, column] = image[:, width - column]
    return result

# %% name="transposed" origin="new" sentence="image.T exchanges rows and columns: keep the rows, and reverse the order of the columns." must_say=["transpos|rows and columns|\\.T", "revers|column|order|axes|swap"] kind="value"
def mirror(image):
    return image.T

# %% name="the unchanged image" origin="new" sentence="The image comes back unchanged: reverse the columns with a step of -1." must_say=["unchanged|same|as it is|as given|equal|input", "column|revers|-1|image|step|input"] kind="value"
def mirror(image):
    return image[:, ::1]

# %% name="every second column" origin="new" sentence="A step of -2 drops every second column: the step must be -1." must_say=["second|step|half|-2|columns are missing|fewer", "-1|column|step"] kind="shape"
def mirror(image):
    return image[:, ::-2]

# %% name="list reverse method" origin="new" sentence="reverse() is a method of lists: an array has no reverse; use a slice with the step -1." must_say=["reverse", "list|slice|array|attribute"] kind="error"
def mirror(image):
    return image.reverse()

# %% name="return forgotten" origin="new" sentence="You compute the reversed image but never give it back: write return." must_say=["return"] kind="no-return"
def mirror(image):
    reversed_image = image[:, ::-1]

# %% name="reversed() of the image" origin="walk" sentence="reversed() gives no array: write a slice with the step -1." must_say=["reversed", "-1"] kind="type"
def mirror(image):
    return reversed(image)
