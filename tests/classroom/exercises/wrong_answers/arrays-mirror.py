# %% name="reversed() of the image" sentence="reversed() gives no array: write a slice with the step -1." must_say=["reversed", "-1"] kind="type"
def mirror(image):
    return reversed(image)

# %% name="rows reversed" sentence="You reverse the rows, so top and bottom are exchanged: leave the rows (:) and reverse the columns with ::-1." must_say=["rows?|top|bottom|upside", "column|second|, ?::-1|left"] kind="value"
def mirror(image):
    return image[::-1]

# %% name="list reverse method" sentence="reverse() is a method of lists: an array has no reverse; use a slice with the step -1." must_say=["reverse", "list|slice|array|attribute"] kind="error"
def mirror(image):
    return image.reverse()

# %% name="return forgotten" sentence="You compute the reversed image but never give it back: write return." must_say=["return"] kind="no-return"
def mirror(image):
    reversed_image = image[:, ::-1]

# %% name="stop 0 loses the first column" sentence="The slice width:0:-1 stops before column 0, so the first column is lost: write image[:, ::-1]." must_say=["first column|column 0|stop|los|one column|::-1|width"] must_not_say=["step"] kind="shape"
def mirror(image):
    width = image.shape[1]
    return image[:, width:0:-1]
