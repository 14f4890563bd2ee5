# %% name="second name is no copy" origin="fresh" sentence="result = gray copies nothing, it is a second name for the same array: write gray.copy()." must_say=["copy"] kind="input-changed"
def paint_white(gray, mask):
    result = gray
    result[mask] = 255
    return result

# %% name="only the painted pixels" origin="fresh" sentence="Where the mask is False the pixel must stay as it is; you make it 0." must_say=["unchanged|elsewhere|stay|keep|black|other pixels|becomes? 0|are 0"] kind="value"
def paint_white(gray, mask):
    result = np.zeros(gray.shape, dtype=np.uint8)
    result[mask] = 255
    return result

# %% name="adds white" origin="fresh" sentence="uint8 wraps around: 100 + 255 gives 99. Do not add, assign 255." must_say=["wrap|assign|add(ing|ition)?\\b|256|overflow"] must_not_say=["copy"] kind="value"
def paint_white(gray, mask):
    return gray + mask.astype(np.uint8) * 255

# %% name="not the mask" origin="fresh" sentence="You paint where the mask is False; ~ reverses it." must_say=["~|False|revers|opposite|invert|outside|not"] must_not_say=["copy|wrap"] kind="value"
def paint_white(gray, mask):
    painted = gray.copy()
    painted[~mask] = 255
    return painted

# %% name="returns the assignment" origin="fresh" sentence="Your function returns nothing: end it with return painted." must_say=["return"] kind="no-return"
def paint_white(gray, mask):
    painted = gray.copy()
    painted[mask] = 255
