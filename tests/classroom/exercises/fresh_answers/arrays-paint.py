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

# %% name="mask as numbers" origin="fresh" sentence="A mask of integers is a list of row numbers: it must stay bool." must_say=["bool|row|index|integer|is mask enough"] must_not_say=["argument mask itself"] kind="value"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask.astype(int)] = 255
    return result

# %% name="the input is changed" origin="fresh" sentence="gray itself is changed: begin with a copy." must_say=["copy|changed"] kind="input-changed"
def paint_white(gray, mask):
    gray[mask] = 255
    return gray

# %% name="second name, no copy" origin="fresh" sentence="result is the same array as gray: write gray.copy()." must_say=["copy|changed"] kind="input-changed"
def paint_white(gray, mask):
    result = gray
    result[mask == True] = 255
    return result

# %% name="equality instead of assignment" origin="fresh" sentence="== compares and changes nothing: write = to store." must_say=["==|compare|no value has changed|equal to the input"] kind="value"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] == 255
    return result

# %% name="black elsewhere" origin="fresh" sentence="Elsewhere the gray level must stay, and you write 0." must_say=["unchanged|keeps|stay|gray level"] kind="value"
def paint_white(gray, mask):
    return np.where(mask, 255, 0).astype(np.uint8)

# %% name="mask inverted" origin="fresh" sentence="The mask is inverted: paint where it is True." must_say=["where the mask is True|~|invert|opposite|exchanged"] kind="value"
def paint_white(gray, mask):
    result = gray.copy()
    result[~mask] = 255
    return result

# %% name="chained assignment" origin="fresh" sentence="result becomes the number 255, because = stores it in both names." must_say=["overwritten|both|number"] kind="error"
def paint_white(gray, mask):
    result = mask = 255
    result[mask] = 255
    return result

# %% name="copy without brackets" origin="fresh" sentence="copy is a method: call it with round brackets, copy()." must_say=["round brackets|copy\\(\\)|call"] kind="error"
def paint_white(gray, mask):
    result = gray.copy
    result[mask] = 255
    return result

# %% name="256" origin="fresh" sentence="The largest value of uint8 is 255." must_say=["255"] must_not_say=["widen"] kind="error"
def paint_white(gray, mask):
    white = gray.copy()
    white[mask] = 256
    return white

# %% name="no return" origin="fresh" sentence="The function returns nothing: end with return result." must_say=["return"] kind="no-return"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 255

# %% name="Makes and paints a copy" origin="fresh" sentence="Makes and paints a copy, but returns the unpainted image gray." must_say=["no value has changed|unpainted"] kind="value"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 255
    return gray

# %% name="A slice of an array is a view and no copy" origin="fresh" sentence="A slice of an array is a view and no copy, so the given image is changed." must_say=["changed|view|copy"] kind="input-changed"
def paint_white(gray, mask):
    new = gray[:]      # copy of the image
    new[mask] = 255
    return new

# %% name="Ignores the given mask and makes its own with a hard-coded" origin="fresh" sentence="Ignores the given mask and makes its own with a hard-coded level of 100." must_say=["does not use|ignores"] kind="value"
def paint_white(gray, mask):
    bright = gray > 100
    result = gray.copy()
    result[bright] = 255
    return result

# %% name="return stands inside the outer loop" origin="fresh" sentence="return stands inside the outer loop, so only the first row is painted." must_say=["stands inside"] kind="value"
def paint_white(gray, mask):
    result = gray.copy()
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            if mask[row, col]:
                result[row, col] = 255
        return result

# %% name="Adds 255 to the masked pixels instead of replacing them" origin="fresh" sentence="Adds 255 to the masked pixels instead of replacing them, so they are not 255 (and the dtype is no longer uint8)." must_say=["added|adds"] kind="value"
def paint_white(gray, mask):
    return gray + mask * 255
