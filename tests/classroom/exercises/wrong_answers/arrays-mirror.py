# %% name="rows reversed" origin="new" sentence="You reverse the rows, so top and bottom are exchanged: leave the rows (:) and reverse the columns with ::-1." must_say=["rows?|top|bottom|upside", "column|second|, ?::-1|left"] kind="value"
def mirror(image):
    return image[::-1]

# %% name="reversed in place by a loop" origin="new" sentence="You change the given image, and then the first half is already overwritten when the second half needs it: work on a copy, or use a slice." must_say=["copy|chang", "image|input"] kind="input-changed"
def mirror(image):
    width = image.shape[1]
    for column in range(width):
        image[:, column] = image[:, width - 1 - column]
    return image

# %% name="index without minus 1" origin="new" sentence="The last column is width - 1, because the index starts at 0: width - column is one too far." must_say=["width - 1|from 0|last|out of|- ?1|one too", "index|column|range|bounds"] kind="error"
def mirror(image):
    result = image.copy()
    width = image.shape[1]
    for column in range(width):
        result[:, column] = image[:, width - column]
    return result

# %% name="the unchanged image" origin="new" sentence="The image comes back unchanged: reverse the columns with a step of -1." must_say=["unchanged|same|as it is|as given|equal|input", "column|revers|-1|image|step|input"] kind="value"
def mirror(image):
    return image[:, ::1]

# %% name="list reverse method" origin="new" sentence="reverse() is a method of lists: an array has no reverse; use a slice with the step -1." must_say=["reverse", "list|slice|array|attribute"] kind="error"
def mirror(image):
    return image.reverse()

# %% name="return forgotten" origin="new" sentence="You compute the reversed image but never give it back: write return." must_say=["return"] kind="no-return"
def mirror(image):
    reversed_image = image[:, ::-1]

# %% name="reversed() of the image" origin="walk" sentence="reversed() gives no array: write a slice with the step -1." must_say=["reversed", "-1"] kind="type"
def mirror(image):
    return reversed(image)
