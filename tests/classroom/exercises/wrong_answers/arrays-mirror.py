# %% name="list reverse method" sentence="reverse() is a method of lists: an array has no reverse; use a slice with the step -1." must_say=["reverse", "list|slice|array|attribute"] kind="error"
def mirror(image):
    return image.reverse()

# %% name="return forgotten" sentence="You compute the reversed image but never give it back: write return." must_say=["return"] kind="no-return"
def mirror(image):
    reversed_image = image[:, ::-1]
