# %% name="border left at 0" sentence="Your border pixels stay 0, because the loop leaves them out: repeat the outermost rows and columns with np.pad(gray, 1, mode=\"edge\") first." must_say=["border|outermost|outer row", "stays? 0|left (at )?0|are 0|black|leaves? (it|them) out|leaves? out|inner|not visited", "pad|repeat|replicat"] must_not_say=["wrong pixel must be gone"] kind="value"
def median3(gray):
    result = np.zeros_like(gray)
    for y in range(1, gray.shape[0] - 1):
        for x in range(1, gray.shape[1] - 1):
            result[y, x] = np.sort(gray[y - 1 : y + 2, x - 1 : x + 2], axis=None)[4]
    return result

# %% name="median of the whole image" sentence="You sort the whole image and get one number; each pixel needs the median of its own 3 × 3 neighbourhood." must_say=["whole image|one number|entire|all pixels", "own|each pixel|every pixel|neighbo"] kind="type"
def median3(gray):
    return np.sort(gray, axis=None)[gray.size // 2]

# %% name="the course's median_blur" sentence="median_blur is the course's own function, from another cell; the task is to write the median yourself: sort the nine values." must_say=["median_blur", "yourself|by hand|own|another cell|other cell|refus|import|write"] kind="other-cell"
def median3(gray):
    return median_blur(gray, 3)
