# %% name="print instead of return" origin="walk" sentence="Your function prints the number but returns nothing: give it back with return, because print only shows it." must_say=["return", "print"] kind="no-return"
def count_pixels(frame):
    print(frame.shape[0] * frame.shape[1])

# %% name="no parameter, global frame" origin="walk" sentence="Your function takes no argument, but it is called with a frame: write count_pixels(frame) and use that parameter, not the frame of another cell." must_say=["argument|parameter|takes no|takes 0", "count_pixels\\(frame\\)|no (argument|parameter)|takes (no|0)|without|parenthes|missing"] must_not_say=["define frame"] kind="error"
def count_pixels():
    return frame.shape[0] * frame.shape[1]

# %% name="function renamed" origin="walk" sentence="The exercise needs a function with the name count_pixels, and this cell defines countpixels: use the name of the task." must_say=["countpixels|\\bnames?\\b|renam|spell", "count_pixels"] kind="other-name"
def countpixels(frame):
    return frame.shape[0] * frame.shape[1]

# %% name="size counts every channel" origin="new" sentence="frame.size counts all numbers in the array, three for each pixel (one per channel): multiply rows by columns only." must_say=["three|\\b3\\b|channel", "size|multipl|times|for each pixel|per pixel"] kind="value"
def count_pixels(frame):
    return frame.size

# %% name="all three of shape multiplied" origin="new" sentence="You also multiply by the 3 channels: a pixel has three numbers, but it is one pixel, so leave the last number of the shape out." must_say=["three|\\b3\\b|channel", "size|multipl|times|one pixel|leave"] kind="value"
def count_pixels(frame):
    height, width, channels = frame.shape
    return height * width * channels

# %% name="hard-coded 720 x 1280" origin="new" sentence="921600 is right only for the frame of the lesson: other images have another size, so compute the number from frame.shape." must_say=["921 ?,?600|720|1280|fixed|hard|constant|typed|other (image|frame|size)s?|another size|any (size|image)|every image|different size", "shape|comput|size|height|rows"] kind="value"
def count_pixels(frame):
    return 720 * 1280

# %% name="rows plus columns" origin="new" sentence="You add rows and columns; a grid of rows and columns has rows times columns pixels, so multiply." must_say=["add|sum|\\+|plus", "multipl|times|product|\\*|×"] kind="value"
def count_pixels(frame):
    rows = frame.shape[0]
    columns = frame.shape[1]
    return rows + columns

# %% name="rows and columns as a tuple" origin="new" sentence="You return two numbers, the rows and the columns, as a tuple: the task asks for one number, so multiply them." must_say=["tuple|pair|returns? (two|both)|two (numbers|values) came", "multipl|one (whole )?number|product"] kind="type"
def count_pixels(frame):
    return frame.shape[0], frame.shape[1]

# %% name="return forgotten" origin="new" sentence="You compute the number but never give it back: end the function with return." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] must_not_say=["print"] kind="no-return"
def count_pixels(frame):
    rows = frame.shape[0]
    columns = frame.shape[1]
    pixels = rows * columns

# %% name="shape called like a function" origin="new" sentence="shape is a tuple, not a function: take its parts with square brackets, frame.shape[0]." must_say=["tuple|not a function|not callable|cannot be called", "bracket|\\[0\\]|\\[ *\\]"] kind="error"
def count_pixels(frame):
    return frame.shape(0) * frame.shape(1)

# %% name="three numbers unpacked into two names" origin="new" sentence="frame.shape has three numbers here (rows, columns, channels) and you give it only two names: take frame.shape[:2], or add a third name." must_say=["three|\\b3\\b|too many", "two|\\b2\\b|unpack|names|\\[:2\\]|third"] kind="error"
def count_pixels(frame):
    rows, columns = frame.shape
    return rows * columns

# %% name="text instead of a number" origin="new" sentence="You return a text (str), but a number was asked for: return rows * columns without the f-string." must_say=["text|string|\\bstr\\b", "number|\\bint\\b"] kind="type"
def count_pixels(frame):
    return f"{frame.shape[0] * frame.shape[1]}"

# %% name="return inside the loop" origin="new" sentence="The return stands inside the outer loop, so the function ends after the first row: move it to the left, below the loops." must_say=["return", "loop|indent|first row|too early"] kind="value"
def count_pixels(frame):
    count = 0
    for row in frame:
        for pixel in row:
            count += 1
        return count

# %% name="loops end one early" origin="new" sentence="range(n) already stops before n, so with range(n - 1) the last row and the last column are not counted: use range(n)." must_say=["range|last|one (row|too few|less|early)|- 1|off by one", "row|column|range"] kind="value"
def count_pixels(frame):
    count = 0
    for y in range(frame.shape[0] - 1):
        for x in range(frame.shape[1] - 1):
            count = count + 1
    return count

# %% name="raise left in place" origin="new" sentence="The line with raise is still there, so your own line below it never runs: delete the raise line." must_say=["raise|NotImplemented|stub", "delete|remove|still|attempt"] kind="not-attempted"
def count_pixels(frame):
    raise NotImplementedError("your turn: delete this line and write the function")
    return frame.shape[0] * frame.shape[1]

# %% name="colon forgotten" origin="new" sentence="Python cannot read this cell: the def line must end with a colon." must_say=["colon|':'|syntax"] kind="syntax"
def count_pixels(frame)
    return frame.shape[0] * frame.shape[1]

# %% name="sum of the values" origin="new" sentence="sum adds up the values of the pixels instead of counting the pixels: use the shape of the array." must_say=["\\bsum\\b|adds? up the (values|numbers|pixels)", "shape|count|row|size"] kind="value"
def count_pixels(frame):
    return frame.sum()

# %% name="fields of a message on an array" origin="new" sentence="A NumPy array has no height and width: its rows and columns stand in frame.shape." must_say=["height|attribute|has no", "shape"] kind="error"
def count_pixels(frame):
    return frame.height * frame.width

# %% name="function of a library without its import" origin="new" sentence="The name math is not known in this cell: write import math in it, or multiply the two numbers yourself." must_say=["math", "import"] kind="missing-import"
def count_pixels(frame):
    return math.prod(frame.shape[:2])

# %% name="shape of another cell's frame" origin="new" sentence="You read the frame from recording, a name of another cell: use the frame that your function receives as its argument." must_say=["recording", "argument|parameter|receive|cell|frame"] kind="other-cell"
def count_pixels(frame):
    first = recording.frame(0)
    return first.shape[0] * first.shape[1]

# %% name="number of different values" origin="new" sentence="np.unique lists the different values, so you count gray levels and not pixels: multiply the rows by the columns." must_say=["unique|different|distinct|gray level", "row|column|shape|pixel"] kind="value"
def count_pixels(frame):
    return len(np.unique(frame))
