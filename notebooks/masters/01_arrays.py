# ---
# jupyter:
#   imgproc_course:
#     title: Arrays
# ---

# %% [markdown]
# # Arrays
#
# An image in a computer is a table of numbers. In Python, the library *NumPy* stores such tables as *arrays*, and can select parts of them and compute with all numbers at once. Here you learn it on images that are small enough to read.
#
# **You will be able to**
# - read and change single pixels, rows, columns and channels,
# - ask an array for its shape and its dtype, and convert it to another dtype,
# - select pixels with a mask, and count them,
# - deeper: replace a loop over all pixels by one line with slices.
#
# **Time** [[minutes]]; take a break after section 5. **You need** [[start_here]]. If you know NumPy, do only the exercises: each is called "Your turn".

# %% role="given" exercise=["arrays-crop", "arrays-mirror", "arrays-red", "arrays-share", "arrays-paint", "arrays-row-means", "arrays-differences"]
import numpy as np

# %%
from imgproc_course.display import show
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.recording import open_recording

# %% role="texts"
figure_texts = {
    "tiny": (
        "The same array as an image: 0 is black, 255 is white. Row 0 is at the top, column 0 is on the left.",
        "A grid of five rows and five columns: a bright vertical line and a darker horizontal line on a dark ground, with one black corner.",
    ),
    "parts": (
        "Rows 1 to 2, then columns 1 to 3, then both. The numbers at the axes are the rows and columns of the part.",
        "Three small parts of the grid: two rows, three columns, and two rows of three columns.",
    ),
    "mirrored": (
        "A step of -1 goes backwards: first over the rows, then over the columns.",
        "The room as it was recorded, upside down, and with left and right exchanged.",
    ),
    "channels": (
        "The ball and its three channels. The red stripe is bright only in the red channel; the white stripe is bright in all three.",
        "A ball with red and white stripes in colour, and three gray images of it: in two of them the red stripe is dark.",
    ),
    "mask": (
        "The mask is True (white) where the pixel is brighter than 100, and False (black) elsewhere.",
        "The grid with its numbers, and the same grid in black and white: only the vertical line is white.",
    ),
    "rows": (
        "The same row three times: without its last two numbers, without its ends, without its first two. Each column has the left neighbour of a pixel, the pixel, and its right neighbour.",
        "Three short rows of numbers, one above the other, each shifted by one column.",
    ),
    "steps": (
        "Gray where neighbours are equal, bright where the intensity jumps up, dark where it jumps down: the outlines of things.",
        "The room as a gray relief: bright and dark lines at the left and right outlines of the person, the chair and the boxes.",
    ),
    "padded": (
        "The image with a border of zeros, and the image with a border that repeats its outermost pixels.",
        "Two grids of seven rows and seven columns around the same five by five numbers.",
    ),
}

# %% [markdown]
# ## 1 · A table of numbers ([[minutes]])
#
# `np.array` makes an array from a list of rows. `dtype=np.uint8` says what kind of numbers it holds: whole numbers from 0 to 255. The `shape` is the number of rows and the number of columns. `size` is the number of all its numbers.

# %%
tiny = np.array(
    [[10, 10, 200, 10, 10],
     [10, 10, 200, 10, 10],
     [90, 90, 200, 90, 90],
     [10, 10, 200, 10, 10],
     [10, 10, 200, 10, 0]],
    dtype=np.uint8)
print(tiny)
print("shape:", tiny.shape, "  size:", tiny.size)

# %%
show(tiny, "tiny", text="arrays/tiny")

# %%
# Check: the numbers in this section
assert tiny.shape == (5, 5) and tiny.size == 25 and tiny[0, 0] == 10

# %% [markdown]
# ## 2 · One pixel: the index ([[minutes]])
#
# The *index* of a pixel is its row and its column, in square brackets. Python counts from 0. Negative numbers count from the end: row −1 is the last row.
#
# **Predict.** Which number is `tiny[2, 4]`? Write it into the next cell, and run both cells.

# %% role="predict"
guess_pixel = None  # your guess: a number instead of None

# %%
print("tiny[0, 0]:", tiny[0, 0], "  tiny[4, 4]:", tiny[4, 4])
print("tiny[-1, -1]:", tiny[-1, -1])
compare_guess(guess_pixel, tiny[2, 4])

# %% [markdown]
# Row 2, column 4: the third row, and its last number. The same index on the left of `=` changes a pixel. We change it in a *copy*; section 8 says why.

# %%
changed = tiny.copy()
changed[0, 0] = 255
print("first row before:", tiny[0], "  after:", changed[0])

# %%
# Check: the numbers in this section
assert tiny[2, 4] == 90 and tiny[4, 4] == tiny[-1, -1] == 0
assert changed[0].tolist() == [255, 10, 200, 10, 10] and tiny[0, 0] == 10

# %% [markdown]
# ## 3 · A part: the slice ([[minutes]])
#
# A *slice* `start:stop` selects several rows or columns. The start is included, the stop is not: `1:3` means the rows 1 and 2. Without a start it begins at 0; without a stop it goes to the end. A colon alone, `:`, means all.

# %%
two_rows = tiny[1:3]
three_columns = tiny[:, 1:4]
both = tiny[1:3, 1:4]
show([two_rows, three_columns, both], ["[1:3]", "[:, 1:4]", "[1:3, 1:4]"],
     text="arrays/parts")

# %% [markdown]
# **Predict.** What is the shape of `tiny[:2, 3:]`?

# %% role="predict"
guess_shape = None  # your guess: (rows, columns)

# %%
part = tiny[:2, 3:]
print(part)
compare_guess(guess_shape, part.shape)

# %%
# Check: the numbers in this section
assert two_rows.shape == (2, 5) and three_columns.shape == (5, 3) and both.shape == (2, 3)
assert part.shape == (2, 2)

# %% [markdown]
# ### Your turn: crop
#
# To *crop* an image is to cut out a rectangle. Write `crop(image, top, bottom, left, right)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `image`: an image, (height, width) or (height, width, 3) | its rows from `top` to `bottom` − 1 and its columns from `left` to `right` − 1 | `crop(tiny, 1, 3, 1, 4)` equals `both` |

# %% role="exercise"
exercise(
    "arrays-crop",
    title="Crop an image",
    function="crop",
    time_limit=5,
    hint="A slice starts at its first number and ends before its second; in the brackets the rows stand before the columns.",
    hints=(
        "Which two slices did `tiny[1:3, 1:4]` use? Which of your five parameters stand for 1, 3, 1 and 4?",
        "Write one pair of brackets after image. First the slice of the rows, then a comma, then the slice of the columns. Return the result.",
        "return image[top:bottom, ...] with the slice of the columns in place of the three dots.",
    ),
    explanation="The first slice selects rows, the second columns. The third axis of a colour image needs no slice: an axis that you do not name is taken whole.",
    another_way="You can also write image[slice(top, bottom), slice(left, right)]: slice(1, 3) is the same as 1:3.",
)

# %% role="answer"
def crop(image, top, bottom, left, right):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def crop(image, top, bottom, left, right):
    return image[top:bottom, left:right]


# %% role="check"
check("arrays-crop", crop)

# %% role="case" title="a gray image" points=1
def inputs(rng):
    return (rng.integers(0, 256, (6, 9), dtype=np.uint8), 1, 4, 2, 7)

# %% role="case" title="a colour image, another part" points=0
def inputs(rng):
    return (rng.integers(0, 256, (5, 4, 3), dtype=np.uint8), 2, 5, 0, 2)

# %% role="hidden" title="other parts" points=1
def inputs(rng):
    image = rng.integers(0, 256, (12, 10, 3), dtype=np.uint8)
    top, left = (int(value) for value in rng.integers(0, 4, size=2))
    return [(image, top, top + 5, left, left + 3), (image, 0, 12, 0, 10)]


# %% [markdown]
# ## 4 · A step, forwards and backwards ([[minutes]])
#
# A slice may have a third number, the *step*. `::2` takes every second row. A step of `-1` goes backwards: `::-1` begins at the end. An *axis* (rows, columns or channels) without a slice stays whole.

# %%
frame = open_recording("drive").frame(30)
small = frame[::4, ::4]
print("frame:", frame.shape, "  every fourth row and column:", small.shape)
show([small, small[::-1], small[:, ::-1]], ["small", "[::-1]", "[:, ::-1]"],
     text="arrays/mirrored")

# %% [markdown]
# **Predict.** Here is a row of five numbers: 1, 2, 3, 4, 5. What is `row[::-2]`?

# %% role="predict"
guess_row = None  # your guess: the numbers, for example (1, 2)

# %%
row = np.array([1, 2, 3, 4, 5])
compare_guess(guess_row, tuple(row[::-2].tolist()))

# %%
# Check: the numbers in this section
assert frame.shape == (720, 1280, 3) and small.shape == (180, 320, 3)
assert row[::-2].tolist() == [5, 3, 1]

# %% [markdown]
# ### Your turn: mirror ([[minutes]], deeper)
#
# In a mirror, left and right are exchanged. Write `mirror(image)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `image`: an image, (height, width) or (height, width, 3) | an array: the image with its columns in reverse order, same shape and dtype (the type counts) | `mirror(tiny)[4, 0]` is 0 |

# %% role="exercise"
exercise(
    "arrays-mirror",
    title="Mirror an image",
    function="mirror",
    exact_type=True,
    time_limit=5,
    hint="The rows stay as they are; only the order of the columns is reversed.",
    hints=(
        "Which of the three images above shows the room in a mirror? Which slice made it?",
        "Take all rows with a single colon. Then, after a comma, take the columns with a step of -1.",
        "return image[:, ...] with the slice that goes backwards in place of the three dots.",
    ),
    explanation="The first index, a colon, keeps every row. The second goes over the columns backwards, from the last to the first. The channels of a colour image are a third axis; it is not named, so it is taken whole.",
    another_way="You can also write np.fliplr(image): the name stands for \"flip left and right\".",
)

# %% role="answer"
def mirror(image):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def mirror(image):
    return image[:, ::-1]


# %% role="check"
check("arrays-mirror", mirror)

# %% role="case" title="a gray image" points=1
def inputs(rng):
    return (rng.integers(0, 256, (4, 6), dtype=np.uint8),)

# %% role="case" title="a colour image" points=0
def inputs(rng):
    return (rng.integers(0, 256, (3, 4, 3), dtype=np.uint8),)

# %% role="hidden" title="other images" points=1
def inputs(rng):
    return [
        (rng.integers(0, 256, (7, 5), dtype=np.uint8),),
        (rng.integers(0, 256, (5, 8, 3), dtype=np.uint8),),
    ]


# %% [markdown]
# ## 5 · Channels and the three dots ([[minutes]])
#
# A colour image has a third index, the *channel*: 0 is blue, 1 is green, 2 is red. So `frame[:, :, 2]` is the red channel of all pixels. Three dots, `...`, mean "all axes that I do not name": `frame[..., 2]` is the same.

# %%
ball = frame[340:440, 430:530]
blue, green, red = ball[..., 0], ball[..., 1], ball[..., 2]
print("part of the frame:", ball.shape, "  one channel:", red.shape)
show([ball, blue, green, red], ["ball", "blue", "green", "red"], columns=2,
     text="arrays/channels")

# %% [markdown]
# **Predict.** What is the shape of `frame[..., ::-1]`?

# %% role="predict"
guess_channels = None  # your guess: three numbers in parentheses

# %%
swapped = frame[..., ::-1]  # the channels in reverse order: red, green, blue
compare_guess(guess_channels, swapped.shape)

# %%
# Check: the numbers in this section
assert (frame[..., 2] == frame[:, :, 2]).all() and red.shape == (100, 100)
assert swapped.shape == frame.shape and (swapped[..., 0] == frame[..., 2]).all()

# %% [markdown]
# ### Your turn: the red channel ([[minutes]], deeper)
#
# Write `red_channel(bgr)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `bgr`: a frame, (height, width, 3) uint8, channels blue, green, red | its red channel, (height, width) uint8 | `red_channel(ball)` equals `red` |

# %% role="exercise"
exercise(
    "arrays-red",
    title="The red channel",
    function="red_channel",
    time_limit=5,
    hint="Which number does the red channel have? The order is blue, green, red, and Python counts from 0.",
    hints=(
        "At which place of the index does the channel stand: first, second or third?",
        "Keep all rows and all columns, and take the channel number 2.",
        "return bgr[..., ?] with the number of the red channel in place of the question mark.",
    ),
    explanation="The three dots keep all rows and all columns. The number 2 selects one channel, and an axis that is selected with a number disappears: three axes become two.",
    another_way="You can also write bgr[:, :, 2]: a colon for the rows, and a colon for the columns.",
)

# %% role="answer"
def red_channel(bgr):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def red_channel(bgr):
    return bgr[..., 2]


# %% role="check"
check("arrays-red", red_channel)

# %% role="case" title="a small image" points=1
def inputs(rng):
    return (rng.integers(0, 256, (4, 5, 3), dtype=np.uint8),)

# %% role="hidden" title="other images" points=1
def inputs(rng):
    return [(rng.integers(0, 256, (rows, 4, 3), dtype=np.uint8),) for rows in (3, 6)]


# %% [markdown]
# ## 6 · The kind of number: dtype ([[minutes]])
#
# All numbers of an array have the same kind, its *dtype* (data type):
#
# | dtype | numbers | bytes (8 bits each) |
# |---|---|---|
# | `uint8` (most images) | whole, 0 to 255 | 1 |
# | `uint16` | whole, 0 to 65,535 | 2 |
# | `int16` | whole, −32,768 to 32,767 | 2 |
# | `float64` | with decimals | 8 |
# | `bool` | True or False | 1 |
#
# `astype` converts to another dtype. The result is a new array.

# %%
print(tiny[2], tiny[2].dtype)
print(tiny[2] / 4, (tiny[2] / 4).dtype)
print((tiny[2] / 4).astype(np.uint8), "after astype(np.uint8)")

# %% [markdown]
# NumPy computes with all numbers at once; you need no loop. The single number 4 is used for each of them: this is called *[[term:broadcasting]]*. `/` gives floats; `astype(np.uint8)` cuts off the decimals: 22.5 becomes 22.
#
# **Predict.** A `uint8` holds no negative number. What is 0 − 1 in `uint8`?

# %% role="predict"
guess_zero = None  # your guess: a number

# %%
zero = np.array([0], dtype=np.uint8)
one = np.array([1], dtype=np.uint8)
compare_guess(guess_zero, (zero - one)[0])

# %% [markdown]
# Below 0 the numbers go on at 255, and NumPy does not warn you. If a result may be negative or above 255, convert to a larger dtype *first*: this is called *widening*.

# %%
print(zero.astype(np.int16) - one)

# %%
# Check: the numbers in this section
assert (tiny[2] / 4).tolist() == [22.5, 22.5, 50, 22.5, 22.5]
assert (zero - one)[0] == 255 and (zero.astype(np.int16) - one)[0] == -1
assert np.iinfo(np.uint8).max == 255 and np.iinfo(np.uint16).max == 65_535
assert np.iinfo(np.int16).min == -32_768 and np.iinfo(np.int16).max == 32_767
assert [np.dtype(name).itemsize for name in ("uint8", "uint16", "int16", "float64", "bool")] == [1, 2, 2, 8, 1]

# %% [markdown]
# ## 7 · Masks ([[minutes]])
#
# A comparison with an array gives True or False for each pixel. Such an array is a *mask*.

# %%
bright = tiny > 100
print(bright.astype(int))  # 1 for True, 0 for False
show([tiny, bright], ["tiny", "tiny > 100"], text="arrays/mask")

# %% [markdown]
# True counts as 1, and False as 0. So the *sum* of a mask is the number of its True pixels, and its *mean* is their share: between 0 (none) and 1 (all).
#
# **Predict** the mean of `bright`: count its True pixels, and divide by 25.

# %% role="predict"
guess_mean = None  # your guess: a number between 0 and 1

# %%
print("True pixels:", bright.sum(), "of", bright.size)
compare_guess(guess_mean, bright.mean())

# %% [markdown]
# A mask in square brackets selects pixels: `tiny[bright]`. On the left of `=` it changes them all. `np.where(mask, a, b)` makes a new array with `a` where the mask is True and `b` where it is False.

# %%
print("selected:", tiny[bright])
print(np.where(tiny > 100, 1, 0))

# %% [markdown]
# Three signs combine masks: `&` (and), `|` (or), `~` (not). Write each comparison in parentheses.

# %%
middle = (tiny > 50) & (tiny < 150)
print("between 50 and 150:", middle.sum(), "pixels;  not bright:", (~bright).sum())

# %%
# Check: the numbers in this section
assert bright.sum() == 5 and bright.mean() == 0.2 and tiny[bright].tolist() == [200] * 5
assert middle.sum() == 4 and (~bright).sum() == 20

# %% [markdown]
# ### Your turn: how many percent are bright? ([[minutes]], deeper)
#
# Write `bright_percent(gray, level)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: an image, (height, width) uint8; `level`: a number | how many percent of the pixels are brighter than `level`, a float from 0 to 100 | `bright_percent(tiny, 100)` is 20.0 |

# %% role="exercise"
exercise(
    "arrays-share",
    title="How many percent are bright",
    function="bright_percent",
    time_limit=5,
    hint="The mean of the mask is the share, from 0 to 1. Percent is 100 times the share.",
    hints=(
        "Which comparison gives True for a pixel that is brighter than level?",
        "Make the mask, take its mean, and multiply by 100.",
        "return (gray > level).mean() * ? with the right number in place of the question mark.",
    ),
    explanation="gray > level is a mask with one True or False for each pixel. True counts as 1, so its mean is the share of the bright pixels; 100 times the share is percent.",
    another_way="You can also count: 100 * np.count_nonzero(gray > level) / gray.size.",
)

# %% role="answer"
def bright_percent(gray, level):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def bright_percent(gray, level):
    return float((gray > level).mean() * 100)

# %% role="check"
check("arrays-share", bright_percent)

# %% role="case" title="few gray levels, then many" points=1
def inputs(rng):
    gray = np.array([[10, 50, 50, 90, 90], [10, 90, 90, 90, 200], [10, 10, 90, 90, 90]], dtype=np.uint8)
    return [(rng.permutation(gray), 50), (rng.integers(0, 256, (6, 8), dtype=np.uint8), 90),
            (rng.integers(0, 256, (30, 41), dtype=np.uint8), 150)]


# %% role="case" title="another level" points=0
def inputs(rng):
    return (rng.integers(0, 256, (7, 9), dtype=np.uint8), 200)

# %% role="hidden" title="other images" points=1
def inputs(rng):
    gray = rng.integers(0, 5, (3, 7), dtype=np.uint8)
    gray[0, :2] = 0, 4  # some of the 21 pixels are bright, not all: never a whole number of percent
    return [*((gray, level) for level in (2, 1, 4)), (rng.integers(0, 256, (30, 41), dtype=np.uint8), 100)]


# %% [markdown]
# ## 8 · Copy and view ([[minutes]], deeper)
#
# **Predict.** We take the first row of an array with an index, and set the first number of this row to 255. What is `original[0, 0]` after that?

# %% role="predict"
guess_view = None  # your guess: a number

# %%
original = tiny.copy()
first_row = original[0]
first_row[0] = 255
compare_guess(guess_view, original[0, 0])

# %% [markdown]
# The array changed, although we wrote to `first_row`. A row or a slice is a *view*: another name for the same numbers in memory. Also `b = a` copies nothing. To keep the original, write `.copy()` first. (`astype`, `np.where` and a calculation such as `a + 1` make new arrays.)

# %%
safe = tiny[0].copy()
safe[0] = 255
print("tiny[0]:", tiny[0], "  the copy:", safe)

# %%
# Check: the numbers in this section
assert original[0, 0] == 255 and tiny[0, 0] == 10 and safe[0] == 255

# %% [markdown]
# ### Your turn: paint ([[minutes]], deeper)
#
# Write `paint_white(gray, mask)`. The check also tests that the given image stays as it is.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: an image, (height, width) uint8; `mask`: (height, width) bool | a new image: 255 where the mask is True, unchanged elsewhere | `paint_white(tiny, bright)[0]` is 10, 10, 255, 10, 10 |

# %% role="exercise"
exercise(
    "arrays-paint",
    title="Paint with a mask",
    function="paint_white",
    time_limit=5,
    hint="255 where the mask is True; every other pixel keeps its gray level.",
    hints=(
        "Which method gives you an array that you may change?",
        "Copy gray. Then select the pixels of the copy with the mask, and set them to 255. Return the copy.",
        "Three lines: result = gray.copy(), then result[?] = 255, then return result.",
    ),
    explanation="The copy may be changed, and the given image stays as it is. The mask in square brackets selects the pixels, and = sets them all to 255.",
    another_way="You can also write np.where(mask, np.uint8(255), gray): a new array without a copy first.",
)

# %% role="answer"
def paint_white(gray, mask):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 255
    return result


# %% role="check"
check("arrays-paint", paint_white)

# %% role="case" title="a small image" points=1
def inputs(rng):
    return (rng.integers(3, 250, (4, 6), dtype=np.uint8), rng.random((4, 6)) > 0.6)

# %% role="hidden" title="other images" points=1
def inputs(rng):
    return [(rng.integers(3, 250, (5, 5), dtype=np.uint8), rng.random((5, 5)) > 0.4) for _ in range(3)]


# %% [markdown]
# ## 9 · One axis at a time ([[minutes]], deeper)
#
# `mean`, `sum`, `min` and `max` take all numbers together, or one *axis* at a time. The named axis disappears: `axis=0` goes down the rows and leaves one number for each column; `axis=1` goes across the columns and leaves one for each row.
#
# **Predict.** `tiny.max(axis=0)` has one number for each column. Which is the largest number of the last column?

# %% role="predict"
guess_column = None  # your guess: a number

# %%
print("max of all:", tiny.max(), "  one for each column:", tiny.max(axis=0))
compare_guess(guess_column, tiny.max(axis=0)[-1])

# %%
# Check: the numbers in this section
assert tiny.max() == 200 and tiny.max(axis=0).tolist() == [90, 90, 200, 90, 90]
assert frame.mean(axis=2).shape == (720, 1280)

# %% [markdown]
# ### Your turn: the mean of each row ([[minutes]], deeper)
#
# Write `row_means(gray)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: an image, (height, width) uint8 | the mean [[term:gray level]] of each row, (height,) float64 | `row_means(tiny)[2]` is 112.0 |

# %% role="exercise"
exercise(
    "arrays-row-means",
    title="The mean of each row",
    function="row_means",
    time_limit=5,
    hint="Which axis goes across the columns, so that one number is left for each row?",
    hints=(
        "The result has one number for each row. Which axis must disappear?",
        "Use the method mean of the array, and tell it the axis that goes across the columns.",
        "return gray.mean(axis=?) with 0 or 1 in place of the question mark.",
    ),
    explanation="axis=1 computes across the columns: this axis disappears, and one mean for each row is left. mean widens to float64 itself, so nothing overflows.",
    another_way="You can also write gray.sum(axis=1) / gray.shape[1]: the sum of each row, divided by its number of pixels.",
)

# %% role="answer"
def row_means(gray):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def row_means(gray):
    return gray.mean(axis=1)

# %% role="check"
check("arrays-row-means", row_means)

# %% role="case" title="a small image" points=1
def inputs(rng):
    return (20 * rng.integers(5, 13, (3, 7), dtype=np.uint8),)

# %% role="hidden" title="other images" points=1
def inputs(rng):
    return [(rng.integers(0, 256, (6, 4), dtype=np.uint8),), (rng.integers(0, 256, (2, 9), dtype=np.uint8),)]


# %% [markdown]
# ## 10 · Neighbours: a loop, and the same with slices ([[minutes]], deeper)
#
# Most methods of [[term:image processing]] compare a pixel with its neighbours. For each pixel of a row, we want the sum of its left neighbour, itself, and its right neighbour. With a loop:

# %%
row = np.array([10, 10, 10, 200, 200, 200])
sums = []
for column in range(1, len(row) - 1):
    sums.append(int(row[column - 1] + row[column] + row[column + 1]))
print(sums)

# %% [markdown]
# The loop leaves out the two ends, which have only one neighbour. Now we take the row three times, each time *shifted* by one column. (`np.stack` puts the three rows one above the other.)

# %%
left, middle, right = row[:-2], row[1:-1], row[2:]
show(np.stack([left, middle, right]), "left, middle, right",
     text="arrays/rows")

# %% [markdown]
# Each column has three numbers that the loop adds. So we add the three arrays:

# %%
print((left + middle + right).tolist())

# %% [markdown]
# The same numbers, in one line. `row[2:]` begins two numbers later, so it holds the *right* neighbours of `row[1:-1]`. In an image `gray`, `gray[1:-1, 2:]` holds the right neighbours of `gray[1:-1, 1:-1]`.

# %%
# Check: the numbers in this section
assert sums == (left + middle + right).tolist() == [30, 220, 410, 600]
assert len(sums) == len(row) - 2

# %% [markdown]
# ### Padding ([[minutes]], deeper)
#
# The result has two numbers fewer than the row. To keep the length, first add a border: this is called *padding*. `np.pad` adds zeros, or repeats the outermost pixels.

# %%
zeros = np.pad(tiny, 1)
repeated = np.pad(tiny, 1, mode="edge")
print("before:", tiny.shape, "  after:", zeros.shape)
show([zeros, repeated], ["zeros", "outermost pixels repeated"], text="arrays/padded")

# %%
# Check: the two borders
assert zeros.shape == repeated.shape == (7, 7)
assert zeros[0, 0] == 0 and repeated[0, 0] == tiny[0, 0]

# %% [markdown]
# ### Your turn: differences ([[minutes]], deeper)
#
# Where the gray level jumps from one pixel to the next, there is an [[term:edge]]. Write `differences(gray)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: an image, (height, width) uint8 | for each pixel its right neighbour minus the pixel itself, (height, width − 1), int16 or a larger type | `differences(tiny)[0]` is 0, 190, −190, 0 |
#
# A difference may be negative: remember section 6.

# %% role="exercise"
exercise(
    "arrays-differences",
    title="Differences of neighbours",
    function="differences",
    time_limit=5,
    hint="The right neighbour minus the pixel itself, in a dtype that has negative numbers.",
    hints=(
        "Which columns have a right neighbour? And which columns are the right neighbours of these?",
        "Widen to int16 first. Then take all columns but the first, minus all columns but the last.",
        "wide = gray.astype(np.int16), then return wide[:, 1:] - wide[:, ?] with the second slice in place of the question mark.",
    ),
    explanation="wide[:, 1:] begins one column later, so it holds the right neighbours of wide[:, :-1]. The array is widened before the subtraction, because uint8 has no negative numbers.",
    another_way="You can also write np.diff(gray.astype(np.int16), axis=1): diff subtracts each number from the next one.",
)

# %% role="answer"
def differences(gray):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def differences(gray):
    wide = gray.astype(np.int16)
    return wide[:, 1:] - wide[:, :-1]


# %% role="check"
check("arrays-differences", differences)

# %% role="case" title="a small image" points=1
def inputs(rng):
    gray = rng.integers(0, 256, (3, 6), dtype=np.uint8)
    gray[0, :2] = (10, 240)
    gray[1, :2] = (240, 10)
    return (gray,)

# %% role="hidden" title="other images" points=1
def inputs(rng):
    return [(rng.integers(0, 256, (5, 5), dtype=np.uint8),), (rng.integers(0, 256, (2, 9), dtype=np.uint8),)]


# %% [markdown]
# ### The differences of the whole room ([[minutes]], deeper)
#
# NumPy has a function for differences, `np.diff`. Here it is applied to the whole room.

# %%
steps = np.diff(frame[..., 1].astype(np.int16), axis=1)  # of the green channel
# limits: -40 and less is black, 40 and more is white
print("shape:", steps.shape, "  range:", steps.min(), "to", steps.max())
show(steps, "differences", limits=(-40, 40), text="arrays/steps")

# %%
# Check: the numbers in this section and in the table below
assert steps.shape == (720, 1279) and steps.dtype == np.int16
assert tiny.min() == 0 and tiny.max() == 200

# %% [markdown]
# ## Recap
#
# Rows first, then columns, then channels. A slice selects a part, a mask selects pixels. Shifted slices replace a loop over neighbours. Copy before you change.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *tiny* | (5, 5) | uint8 | 0 to 200 | gray level |
# | mask, `tiny > 100` | (5, 5) | bool | False, True | – |
#
# **Next:** [[what_is_image_processing]].
