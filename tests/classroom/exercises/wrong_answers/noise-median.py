# %% name="median of the whole image" sentence="You sort the whole image and get one number; each pixel needs the median of its own 3 × 3 neighbourhood." must_say=["whole image|one number|entire|all pixels", "own|each pixel|every pixel|neighbo"] kind="type"
def median3(gray):
    return np.sort(gray, axis=None)[gray.size // 2]

# %% name="the course's median_blur" sentence="median_blur is the course's own function, from another cell; the task is to write the median yourself: sort the nine values." must_say=["median_blur", "yourself|by hand|own|another cell|other cell|refus|import|write"] kind="other-cell"
def median3(gray):
    return median_blur(gray, 3)
