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

# %% name="length as the stop" origin="fresh" sentence="The stop of a slice is a place, not a length: bottom itself, not bottom - top." must_say=["\\bstop\\b|place|length|ends? (before|at)|bottom"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom - top, left:right - left]

# %% name="return in the loop over the rows" origin="fresh" sentence="return stands inside the loop, so the function ends in the first round." must_say=["return.*(loop|inside)|first (round|pass|row)"] kind="value"
def crop(image, top, bottom, left, right):
    rows = []
    for row in range(top, bottom):
        rows.append(image[row][left:right])
        return np.array(rows)

# %% name="both ranges in one bracket each" origin="fresh" sentence="The second slice takes rows again: write both slices in one pair of brackets." must_say=["one pair of brackets|comma|rows again|image\\[top:bottom, left:right\\]"] kind="shape"
def crop(image, top, bottom, left, right):
    return image[top:bottom][left:right]

# %% name="columns first" origin="fresh" sentence="Rows come first: image[top:bottom, left:right]." must_say=["rows (come )?first|rows and columns|exchanged"] kind="value"
def crop(image, top, bottom, left, right):
    part = image[left:right, top:bottom]
    return part

# %% name="print at the end" origin="fresh" sentence="print shows the part but returns nothing: write return." must_say=["return"] kind="no-return"
def crop(image, top, bottom, left, right):
    part = image[top:bottom, left:right]
    print(part)

# %% name="one row too many" origin="fresh" sentence="Each side has one too many: the stop is not included already." must_say=["too many|not included|stop"] kind="shape"
def crop(image, top, bottom, left, right):
    return image[top:bottom + 1, left:right + 1]

# %% name="loops begin one late" origin="fresh" sentence="The loops begin one too late, at top + 1 and left + 1." must_say=["too few|begin|start"] kind="shape"
def crop(image, top, bottom, left, right):
    result = []
    for r in range(top + 1, bottom):
        line = []
        for c in range(left + 1, right):
            line.append(image[r, c])
        result.append(line)
    return np.array(result)

# %% name="misspelled argument" origin="fresh" sentence="The argument is called bottom, and here stands botom." must_say=["bottom"] kind="error"
def crop(image, top, bottom, left, right):
    return image[top:botom, left:right]

# %% name="right argument into left" origin="fresh" sentence="The left side begins at right, so the columns are empty." must_say=["empty|no columns|0 columns|columns? too few"] kind="value"
def crop(image, top, bottom, left, right):
    return image[top:bottom, right:left]

# %% name="method with brackets of a call" origin="fresh" sentence="An array is not called: write square brackets, image[...]." must_say=["square brackets|not a function"] kind="error"
def crop(image, top, bottom, left, right):
    return image(top, bottom)(left, right)

# %% name="Subtracts 1 from bottom and right although a slice already" origin="fresh" sentence="Subtracts 1 from bottom and right although a slice already stops before its end, so the last row and column are missing." must_say=["too few|missing|one too large"] kind="shape"
def crop(image, top, bottom, left, right):
    # rows from top to bottom - 1, columns from left to right - 1
    rows = image[top:bottom - 1, left:right - 1]
    return rows

# %% name="Rows and columns are exchanged" origin="fresh" sentence="Rows and columns are exchanged: the columns' limits are used for the first axis." must_say=["exchanged|rows come first"] kind="shape"
def crop(image, top, bottom, left, right):
    return image[left:right, top:bottom]

# %% name="Prints the rectangle and returns nothing" origin="fresh" sentence="Prints the rectangle and returns nothing, so the result is None." must_say=["print"] kind="no-return"
def crop(image, top, bottom, left, right):
    print(image[top:bottom, left:right])

# %% name="Always asks for a third axis" origin="fresh" sentence="Always asks for a third axis, so it fails for a gray image with two axes." must_say=["third axis|2 axes"] kind="error"
def crop(image, top, bottom, left, right):
    return image[top:bottom, left:right, :]

# %% name="Syntax error" origin="fresh" sentence="Syntax error: the closing square bracket is missing." must_say=["bracket|never closed|error"] kind="syntax"
def crop(image, top, bottom, left, right):
    return image[top:bottom, left:right

# %% name="Computes the rectangle but has no return" origin="fresh" sentence="Computes the rectangle but has no return, so the result is None." must_say=["return"] kind="no-return"
def crop(image, top, bottom, left, right):
    both = image[top:bottom, left:right]

# %% name="The line with raise was not deleted" origin="fresh" sentence="The line with raise was not deleted, so the function stops before it does anything." must_say=["raise|delete"] kind="not-attempted"
def crop(image, top, bottom, left, right):
    raise NotImplementedError("your turn: delete this line and write the function")
    return image[top:bottom, left:right]
