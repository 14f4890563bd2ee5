# %% name="the course's median_blur" sentence="median_blur is the course's own function, from another cell; the task is to write the median yourself: sort the nine values." must_say=["median_blur", "yourself|by hand|own|another cell|other cell|refus|import|write"] kind="other-cell"
def median3(gray):
    return median_blur(gray, 3)
