# ---
# jupyter:
#   imgproc_course:
#     title: The stages of Canny
# ---

# %% [markdown]
# # The stages of Canny
#
# `cv2.Canny(gray, 50, 150)` runs five stages: Sobel, magnitude and direction, non-maximum suppression, double threshold, hysteresis. Here you meet them one by one, and write one of them; in the deeper sections three more.
#
# **You will be able to**
# - name the input and the output of each stage, with their units,
# - explain and apply the two thresholds 50 and 150,
# - deeper: explain why a noisy image must be smoothed before edge detection.
#
# **Time** [[minutes]], best on two days. **You need** [[arrays]], with its section 10 (shifted slices) for what is deeper, and [[grayscale]].

# %% role="given" exercise=["canny-sobel", "canny-suppression", "canny-thresholds", "canny-hysteresis"]
import numpy as np

# %%
import cv2

from imgproc_course.display import draw, show, show_figure, tune
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.imaging import (
    add_gaussian_noise, canny, canny_stages, direction, gaussian_blur,
    gradient_angle, magnitude, sobel, to_gray)
from imgproc_course.recording import open_recording

recording = open_recording("drive")
gray = to_gray(recording.frame(30))
print("gray", gray.shape, gray.dtype, "range", gray.min(), "to", gray.max())

# %% role="texts"
figure_texts = {
    "window": (
        "Nine gray levels, nine weights, nine products. The response of the middle pixel is the sum of the products.",
        "Three grids of three by three numbers: a window with a step from 50 to 200, the Sobel kernel, and their products.",
    ),
    "sobel": (
        "Along the rows the gray level rises by 150: the response is 4 × 150 = 600. Down the columns nothing changes.",
        "Three five by five grids: a step from 50 to 200; a grid with two columns of 600; a grid of zeros.",
    ),
    "arrow": (
        "The arrow points from dark to bright, at a right angle to the edge.",
        "A grid with a slanted edge; an orange arrow points from its middle to the lower right.",
    ),
    "row": (
        "From left to right, broad outlines become thin lines, and the weak ones that touch no strong line go.",
        "Five images of the ball: in gray, its broad bright outlines, thin lines of different brightness, gray and white lines, white lines only.",
    ),
    "sectors": (
        "The outlines in the colours of their sectors: 0 red, 1 yellow, 2 green, 3 blue.",
        "The outlines of ball and marker in four colours: vertical lines red, horizontal lines green, slanted lines yellow or blue.",
    ),
    "hue": (
        "Around the ball the gradient points in every direction, so the hue goes once around the rim; where the rim is dark, the gradient is weak.",
        "The rim of the ball as a ring in all colours of the rainbow, beside the coloured outlines of the marker.",
    ),
    "small": (
        "In each row only the peak keeps its value.",
        "Three five by five grids: gray levels of a soft step, their magnitudes, and the magnitudes of one column only.",
    ),
    "thinned": (
        "The left side of the ball, enlarged: before the suppression each ridge is several pixels wide, after it one pixel. The horizontal lines belong to the shelf behind the ball.",
        "Two enlarged parts of the image: left a broad bright band, right a thin line of single pixels.",
    ),
    "thresholds": (
        "A part of the floor. With the low threshold, the wood pattern appears, too. With the high threshold, the lines between the boards are broken.",
        "Left, the rug, long lines between floor boards and many short lines; right, the rug and only broken lines.",
    ),
    "growth": (
        "The edges after this number of steps.",
        "White lines on black; they get longer with each step.",
    ),
    "noise": (
        "The noise hides the edges, because noisy pixels make intensity steps nearly everywhere.",
        "Left, clear outlines of the room; right, short white lines nearly everywhere.",
    ),
    "repaired": (
        "After a Gaussian blur with sigma = 2 pixels the strong outlines are back, without the noise. Weak ones are lost.",
        "Left, short white lines nearly everywhere; right, the strongest outlines of the room.",
    ),
    "tuner": (
        "Edges of the camera frame.",
        "White lines on black; they change with the sliders.",
    ),
    "cat": (
        "Without blur every hair is an edge. What counts as an edge depends on the scale at which you look.",
        "A cat's face; its edges with all the hairs; its edges after a blur, with eyes, nose and ears only.",
    ),
}

# %% [markdown]
# ## 1 · An edge is an intensity step ([[minutes]])
#
# In this row of an image, the edge is where the gray level (the *intensity*) jumps:
#
# `50  50  50  50  200  200  200  200`
#
# **Predict.** For each pixel, subtract its left neighbour from its right neighbour. At which positions, from 0 to 7, is the result not zero? (`np.pad` with `mode="edge"` first repeats the outermost pixels; without a mode, it adds zeros.)

# %% role="predict"
guess_positions = None  # your guess: which positions, for example (0, 7)?

# %%
row = np.array([50, 50, 50, 50, 200, 200, 200, 200])
padded = np.pad(row, 1, mode="edge")
difference = padded[2:] - padded[:-2]  # right neighbour minus left neighbour
print("row       ", row)
print("difference", difference)
compare_guess(guess_positions, np.flatnonzero(difference))  # where it is not 0

# %% [markdown]
# This is a **[[term:correlation]]** with the kernel `[-1, 0, 1]`, a small table of weights. At each pixel of the row, every weight is multiplied by the gray level under it, and the products are added: the *[[term:filter response]]*. At the step it is the height of the step, 150; from bright to dark it is negative. (A [[term:convolution]] flips the kernel first: see [[noise_removal]].)

# %%
# Check: the numbers in this section
assert difference.tolist() == [0, 0, 0, 150, 150, 0, 0, 0]

# %% [markdown]
# ## 2 · The Sobel kernel, one window by hand ([[minutes]])
#
# Noise easily disturbs the differences in a single row. The **[[term:Sobel kernel]]** combines three rows, and gives the middle row double weight:
#
# $$\begin{bmatrix}-1&0&1\\-2&0&2\\-1&0&1\end{bmatrix}$$
#
# Here is a small image with a *vertical edge*:

# %%
five_rows = [[50, 50, 200, 200, 200]] * 5  # the same row five times
step = np.array(five_rows, dtype=np.uint8)
kernel = np.array([[-1, 0, 1],
                   [-2, 0, 2],
                   [-1, 0, 1]])
print(step)

# %% [markdown]
# For the pixel in row 2 and column 1, the kernel covers a *window*: rows 1 to 3 and columns 0 to 2. Each of the nine gray levels is multiplied by the weight at the same place.
#
# **Predict** the sum of the products. (Each row of the window is 50, 50, 200.)

# %% role="predict"
guess_response = None  # your guess: which number?

# %%
window = step[1:4, 0:3].astype(np.int32)  # a product can be negative
products = window * kernel
print("response:", products.sum())
show([window, kernel, products], ["window", "kernel", "products"],
     text="canny_stages/window")
compare_guess(guess_response, products.sum())

# %% [markdown]
# The response is 600, which is 4 × 150: the height of the step times the sum of the weights 1, 2 and 1. It can be negative or larger than 255, so we widen to `int32` first.
#
# For a *horizontal edge*, the kernel is *[[term:transposed]]*: its rows become columns (`kernel.T`). The course's `sobel` applies both kernels around every pixel. It returns `grad_row`, the change *down a column*, and `grad_col`, the change *along a row*. Together they are the **[[term:gradient]]**.

# %%
grad_row, grad_col = sobel(step)
show([step, grad_col, grad_row],
     ["gray", "grad_col (along a row)", "grad_row (down a column)"],
     text="canny_stages/sobel")

# %% [markdown]
# The factor **4** is important: thresholds are compared with the Sobel response, not with gray levels. At a vertical or horizontal edge, 50 means a step of 12.5 gray levels, and 150 means 37.5.

# %%
# Check: the numbers in this section
assert products.sum() == 600 == 4 * 150 and window.dtype == np.int32
assert grad_col.max() == 600 and not grad_row.any()
assert 50 / 4 == 12.5 and 150 / 4 == 37.5
assert (np.outer([1, 2, 1], [-1, 0, 1]) == kernel).all()

# %% [markdown]
# ## 3 · Your turn: the Sobel filter ([[minutes]], deeper)
#
# Write `my_sobel(gray)`. It computes both parts of the gradient for every pixel.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: (height, width) uint8 | `grad_row, grad_col`, in this order: two (height, width) arrays of a signed type | `grad_row, grad_col = my_sobel(step)` |
#
# - `grad_col` uses the kernel above: right minus left. `grad_row` uses the transposed kernel: the row below minus the row above.
# - At the border use *replicate*: `np.pad(..., 1, mode="edge")` repeats the outermost rows and columns. Then pixel (row, col) of the image is the middle of the window `padded[row : row + 3, col : col + 3]`.
# - Negative values must stay negative: use a signed type, such as `int32`.
# - Use only NumPy; `np` is imported for you. Two loops over all pixels are fast enough. Write the kernel in the answer cell, too.
#
# The Sobel kernel is *[[term:separable filter|separable]]*: it smooths with 1, 2, 1 in one direction, and takes the difference with −1, 0, 1 in the other. These two small filters, one after the other, give the same result with less work.

# %% role="exercise"
exercise(
    "canny-sobel",
    title="The Sobel filter",
    function="my_sobel",
    time_limit=5,
    hint="Widen to int32 and pad by one with mode='edge'. Then add the neighbours, each multiplied by its weight.",
    border_hint="Only the border is wrong. Repeat the outermost rows and columns with np.pad(..., 1, mode='edge'), and compute every pixel.",
    hints=(
        "Section 2 computed the response of one pixel with nine products. What must be different for the next pixel? And which pixels lie around a pixel in the corner of the image?",
        "1. Widen gray to int32, and pad it by one pixel with mode='edge'.\n2. Make two int32 arrays of zeros with the shape of gray.\n3. Go over all rows and columns. Cut the 3 × 3 window of the pixel out of the padded array.\n4. Store the sum of window * kernel in grad_col, and the sum of window * kernel.T in grad_row.\n5. Return grad_row, grad_col.",
        "Before the loops:\n    padded = np.pad(gray.astype(np.int32), 1, mode='edge')\n    grad_col = np.zeros(gray.shape, dtype=np.int32)\nInside the two loops over row and col:\n    window = padded[row : row + 3, col : col + 3]\n    grad_col[row, col] = (window * kernel).sum()\nWhat is different for grad_row? Write kernel inside your function, too.",
    ),
    explanation="The image is widened to int32 first, because a response can be negative or larger than 255. The kernel is separable, so each gradient is computed in two steps: sums with the weights 1, 2, 1, then the difference of two shifted sums. The slices [2:] and [:-2] give the two neighbours of all pixels at once, so no loop is needed.",
    another_way="You can also write two loops over rows and columns, take the 3 × 3 window of each pixel, and sum window * kernel.",
)

# %% role="answer"
def my_sobel(gray):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def my_sobel(gray):
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    smooth_down = padded[:-2] + 2 * padded[1:-1] + padded[2:]
    smooth_along = padded[:, :-2] + 2 * padded[:, 1:-1] + padded[:, 2:]
    grad_row = smooth_along[2:] - smooth_along[:-2]
    grad_col = smooth_down[:, 2:] - smooth_down[:, :-2]
    return grad_row, grad_col


# %% role="check"
check("canny-sobel", my_sobel)

# %% role="case" title="vertical edges: dark, bright, dark" points=1 hint="Here the gray level changes only along the rows, so grad_row is 0 everywhere, and grad_col is not 0 beside each edge. Calculate the nine products of one framed pixel by hand."
def inputs(rng):
    image = np.full((5, 8), rng.integers(0, 100), dtype=np.uint8)
    image[:, rng.integers(2, 4) : 6] = rng.integers(120, 256)
    return (image,)

# %% role="case" title="horizontal edges: dark, bright, dark" points=1 hint="Here the gray level changes only down the columns, so grad_col is 0 everywhere. grad_row is positive where the row below is brighter than the row above, and negative where it is darker."
def inputs(rng):
    image = np.full((8, 5), rng.integers(0, 80), dtype=np.uint8)
    image[rng.integers(2, 4) : 6] = rng.integers(150, 256)
    return (image,)

# %% role="case" title="random pixels up to the border" points=1 hint="Choose one pixel whose value is framed, and calculate its nine products by hand."
def inputs(rng):
    return (rng.integers(0, 256, size=(4, 5), dtype=np.uint8),)

# %% role="hidden" title="any image" points=1 hint="Look at the border: are the outermost pixels repeated?"
def inputs(rng):
    return (rng.integers(0, 256, size=(7, 9), dtype=np.uint8),)

# %% [markdown]
# ## 4 · Gradient magnitude and direction ([[minutes]])
#
# The gradient of a pixel is an arrow: `grad_col` to the right, `grad_row` down. It points from dark to bright, across the edge: this is the **[[term:gradient direction]]** (or orientation). Its length is the **[[term:gradient magnitude]]**, measured by one of two *norms*:
#
# - **L2 norm** √(grad_row² + grad_col²): as with a ruler,
# - **L1 norm** |grad_row| + |grad_col|: as a taxi drives around blocks. `cv2.Canny` uses it, because it is faster.
#
# **Predict** the L1 norm of a gradient with grad_row = −300 and grad_col = 400.

# %% role="predict"
guess_norm = None  # your guess: which number?

# %%
down, right = -300, 400
l1 = abs(down) + abs(right)
l2 = (down**2 + right**2) ** 0.5  # ** 0.5 is the square root
print("L1 norm", l1, "  L2 norm", l2)
compare_guess(guess_norm, l1)

# %% [markdown]
# `canny_stages` runs all stages, and returns the result of each. Here they are for a part of the frame; sections 6 to 9 explain the last three.

# %%
stages = canny_stages(gray, 50, 150)
print(stages.magnitude.shape, stages.magnitude.dtype, "up to", stages.magnitude.max())

# %%
crop = gray[330:430, 430:560]
part = canny_stages(crop, 50, 150)
magnitudes = np.minimum(part.magnitude // 2, 255)
thinned = np.minimum(part.thinned // 2, 255)
levels = np.where(part.strong, 255, part.weak * 100)  # white and gray
in_a_row = np.hstack([crop, magnitudes, thinned, levels, part.edges])
show(in_a_row.astype(np.uint8),
     "gray, magnitude, thinned, weak and strong, edges",
     text="canny_stages/row")

# %%
# Check: the results in this section
assert l1 == 700 and l2 == 500
assert (stages.edges == cv2.Canny(gray, 50, 150)).all() and (canny(gray, 50, 150) == stages.edges).all()

# %% [markdown]
# ### The gradient direction in figures ([[minutes]], deeper)
#
# First a small image with a slanted edge:

# %%
slanted = np.array([[40, 40, 40, 60, 160],
                    [40, 40, 50, 140, 200],
                    [40, 45, 120, 200, 200],
                    [45, 100, 195, 200, 200],
                    [90, 180, 200, 200, 200]], dtype=np.uint8)
down, right = sobel(slanted)
print("middle pixel: grad_row", down[2, 2], "  grad_col", right[2, 2])

# %%
figure, axes = draw(slanted, "gradient of the middle pixel", encoding="mono8")
to_right, to_bottom = right[2, 2] / 400, down[2, 2] / 400  # in pixels
axes[0].arrow(2, 2, to_right, to_bottom, width=0.06, color="tab:orange")
show_figure(figure, text="canny_stages/arrow")

# %% [markdown]
# The figure below shows the direction as the *[[term:hue]]* of a colour, and the magnitude as its brightness. Hue is the place of a colour on the colour wheel: red, yellow, green, blue and back to red. OpenCV's *HSV* image has three channels: hue (in steps of two degrees), saturation (255 is a full colour), and value (the brightness).

# %%
# The angle of the gradient, in degrees
angle = gradient_angle(stages.grad_row, stages.grad_col)
degrees = np.round(angle) % 360  # whole degrees, 0 to 359
hsv = np.zeros((720, 1280, 3), dtype=np.uint8)
hsv[:, :, 0] = degrees // 2
hsv[:, :, 1] = 255
hsv[:, :, 2] = np.minimum(stages.magnitude // 2, 255)
coloured = cv2.cvtColor(hsv, cv2.COLOR_HSV2BGR)
show(coloured, "direction as hue", rows=(310, 440), cols=(430, 740),
     text="canny_stages/hue")

# %%
# Check: the length and direction of the arrow
lengths_l1, lengths_l2 = magnitude(down, right, "L1"), magnitude(down, right, "L2")
assert (lengths_l1 == np.abs(down) + np.abs(right)).all() and (lengths_l1 >= lengths_l2).all()
assert lengths_l2[2, 2] == (int(down[2, 2]) ** 2 + int(right[2, 2]) ** 2) ** 0.5
assert down[2, 2] > 0 and right[2, 2] > 0

# %% [markdown]
# ## 5 · A ridge in one row ([[minutes]], deeper)
#
# If the intensity changes over a few pixels, the magnitudes form a *[[term:ridge]]*. Here is a soft step:
#
# `50  50  60  90  150  190  200  200`
#
# **Predict** at which position (0 to 7) the magnitude is largest.

# %% role="predict"
guess_top = None  # your guess: which position?

# %%
soft = np.array([50, 50, 60, 90, 150, 190, 200, 200], dtype=np.uint8)
_, across = sobel(np.array([soft, soft, soft]))  # three equal rows
profile = np.abs(across[1])  # the magnitudes of the middle row
print("gray     ", soft)
print("magnitude", profile)
compare_guess(guess_top, profile.argmax())  # the position of the largest

# %% [markdown]
# An edge should be one pixel wide: the top of the ridge. OpenCV keeps a pixel if it is *greater than* its left neighbour, and *greater than or equal to* its right neighbour. So one of two equal neighbours is kept.

# %%
# Check: the numbers in this section
assert profile.tolist() == [0, 40, 160, 360, 400, 200, 40, 0]

# %% [markdown]
# ## 6 · Non-maximum suppression: keep only the top of the ridge ([[minutes]])
#
# **Pause?** Afterwards choose **Run → Run All Above Selected Cell**.
#
# If the intensity changes over a few pixels, the magnitudes form a *[[term:ridge]]*. **[[term:non-maximum suppression|Non-maximum suppression]]** compares each pixel with its two neighbours *along its gradient*, across the edge, and keeps it only if its magnitude is a *local maximum* (a peak). A pixel has only eight neighbours, so the direction is rounded to one of four *sectors*:
#
# | sector | the gradient points | first neighbour | second neighbour | kept if |
# |---|---|---|---|---|
# | 0 | along the row | left | right | > first and >= second |
# | 1 | down-right or up-left | above left | below right | > both |
# | 2 | down the column | above | below | > first and >= second |
# | 3 | down-left or up-right | above right | below left | > both |

# %%
sector = direction(stages.grad_row, stages.grad_col)
red, yellow, green, blue = (60, 60, 255), (0, 220, 255), (60, 200, 60), (255, 120, 60)
painted = np.array([red, yellow, green, blue], dtype=np.uint8)[sector]
painted[stages.magnitude < 150] = 0  # black where no strong edge can be
show(painted, "sectors 0 to 3", rows=(310, 440), cols=(430, 740),
     text="canny_stages/sectors")

# %%
before, after = np.minimum(stages.magnitude, 500), np.minimum(stages.thinned, 500)
show([before, after], ["magnitude", "after suppression"], rows=(376, 400),
     cols=(440, 464), numbers=False, text="canny_stages/thinned")

# %%
# Check: the numbers and results in this section
assert (sector == stages.direction).all()

# %% [markdown]
# ### A whole image with two loops ([[minutes]], deeper)
#
# How does OpenCV find the sector without an angle? The border between sectors 0 and 1 is halfway between 0° and 45°, at 22.5°. If |grad_row| is smaller than |grad_col| × 13573 / 32768, the pixel is in sector 0. The fraction is 0.4142, the tangent of 22.5°, written with two integers (32768 is 2¹⁵, so the division is a fast shift).
#
# The next cells walk over *all* pixels of a 5 × 5 image with two loops. Its edge is vertical, so every pixel is compared with its left and right neighbours. Because of the padding, pixel (row, col) is at `zero_padded[row + 1, col + 1]`.

# %%
wall = np.array([[50, 60, 130, 180, 190],
                 [50, 60, 120, 180, 190],
                 [50, 60, 120, 185, 190],
                 [50, 65, 140, 185, 190],
                 [50, 60, 150, 185, 190]], dtype=np.uint8)
wall_magnitude = magnitude(*sobel(wall))  # * passes both gradients

# %%
height, width = wall_magnitude.shape
zero_padded = np.pad(wall_magnitude, 1)
wall_thinned = np.zeros_like(wall_magnitude)
for row in range(height):
    for col in range(width):
        value = zero_padded[row + 1, col + 1]  # the pixel itself
        left, right = zero_padded[row + 1, col], zero_padded[row + 1, col + 2]
        if value > left and value >= right:
            wall_thinned[row, col] = value

# %%
show([wall, wall_magnitude, wall_thinned],
     ["gray", "magnitude", "peaks of each row"], text="canny_stages/small")

# %%
# Check: the peaks of each row, and the tangent
assert 2**15 == 32768
assert round(13573 / 32768, 4) == round(float(np.tan(np.pi / 8)), 4) == 0.4142
assert (direction(*sobel(wall)) == 0).all()
assert (wall_thinned == canny_stages(wall, 50, 150).thinned).all()
assert (wall_thinned > 0).sum(axis=1).tolist() == [1, 1, 1, 1, 1]

# %% [markdown]
# ## 7 · Your turn: non-maximum suppression ([[minutes]], deeper)
#
# Write `suppress(magnitude, sector)`, with the table of section 6. Outside the image the magnitude is 0 (zero padding). Begin with the two loops above: which two neighbours you take depends on the sector of the pixel.
#
# | Input | Output | Example call |
# |---|---|---|
# | `magnitude`: (height, width) int32; `sector`: (height, width) uint8, 0 to 3 | a new (height, width) array: the magnitude where a pixel is kept, 0 elsewhere | `thinned = suppress(stages.magnitude, stages.direction)` |
#
# Use only NumPy; `np` is imported for you.

# %% role="exercise"
exercise(
    "canny-suppression",
    title="Non-maximum suppression",
    function="suppress",
    time_limit=10,
    hint="Pad the magnitude with zeros. Two simple loops over rows and columns are fast enough. For each pixel, the sector says which two neighbours to compare with.",
    border_hint="Only the border is wrong. Outside the image the magnitude is 0: pad with np.pad(magnitude, 1), and compare every pixel.",
    hints=(
        "The loops of section 6 compare every pixel with left and right. What has to depend on sector[row, col]?",
        "1. Pad the magnitude with zeros, and make a result array of zeros.\n2. Go over all rows and columns.\n3. Use if and elif for the four sectors: each branch takes the first and the second neighbour from the padded array, and compares.\n4. If the pixel is kept, write its magnitude into the result.",
        "Inside the two loops, pixel (row, col) is padded[row + 1, col + 1]:\n    value = magnitude[row, col]\n    if sector[row, col] == 0:\n        first, second = padded[row + 1, col], padded[row + 1, col + 2]\n        keep = value > first and value >= second\n    elif sector[row, col] == 1:\n        first, second = padded[row, col], padded[row + 2, col + 2]\n        keep = value > first and value > second\n    Write the branches of sectors 2 and 3 in the same way.\n    if keep:\n        thinned[row, col] = value",
    ),
    explanation="The padding makes the magnitude 0 outside the image, so every pixel has two neighbours, on the border too. The table first_step holds the way from a pixel to its first neighbour for each sector, and the second neighbour is on the opposite side: the same step with a minus. The result is a new array, because a pixel must be compared with the unchanged magnitudes of its neighbours.",
    another_way="You can also write it without loops: compare shifted slices of the padded array for each sector, and combine the four masks with np.where.",
)

# %% role="answer"
def suppress(magnitude, sector):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def suppress(magnitude, sector):
    height, width = magnitude.shape
    padded = np.pad(magnitude, 1)
    first_step = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    thinned = np.zeros_like(magnitude)
    for row in range(height):
        for col in range(width):
            d_row, d_col = first_step[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + 1 + d_row, col + 1 + d_col]
            second = padded[row + 1 - d_row, col + 1 - d_col]
            if sector[row, col] in (0, 2):
                keep = value > first and value >= second
            else:
                keep = value > first and value > second
            if keep:
                thinned[row, col] = value
    return thinned


# %% role="check"
check("canny-suppression", suppress)

# %% role="case" title="a vertical ridge" points=1 hint="Every pixel is in sector 0: compare it with its left and its right neighbour."
def inputs(rng):
    magnitude = np.sort(rng.integers(1, 400, size=(5, 7)), axis=1)[:, [0, 2, 4, 6, 5, 3, 1]].astype(np.int32)
    return magnitude, np.zeros((5, 7), dtype=np.uint8)

# %% role="case" title="equal neighbours" points=1 hint="A pixel must be greater than the first neighbour, and greater than or equal to the second. Then one of two equal neighbours is kept."
def inputs(rng):
    magnitude = np.zeros((6, 5), dtype=np.int32)
    row = rng.integers(1, 4)
    magnitude[row : row + 2] = rng.integers(100, 400)
    return magnitude, np.full((6, 5), 2, dtype=np.uint8)

# %% role="case" title="all four sectors" points=1 hint="Choose one pixel whose value is framed. Look up its sector in the table of section 6, and compare it with these two neighbours."
def inputs(rng):
    return rng.integers(0, 400, size=(7, 8)).astype(np.int32), rng.integers(0, 4, size=(7, 8), dtype=np.uint8)

# %% role="case" title="equal neighbours in all sectors" points=0 hint="In sectors 1 and 3 a pixel must be greater than both neighbours. In sectors 0 and 2 it may be equal to the second one."
def inputs(rng):
    return rng.integers(0, 3, size=(14, 15)).astype(np.int32), rng.integers(0, 4, size=(14, 15), dtype=np.uint8)

# %% role="hidden" title="few values, many equal neighbours" points=1 hint="In sectors 1 and 3 a pixel must be greater than both neighbours."
def inputs(rng):
    return rng.integers(0, 4, size=(12, 15)).astype(np.int32), rng.integers(0, 4, size=(12, 15), dtype=np.uint8)

# %% [markdown]
# ## 8 · The double threshold ([[minutes]])
#
# Which ridges are edges? With a low threshold, the wood pattern of the floor becomes edges; with a high one, outlines get gaps. Canny uses a **[[term:double threshold]]**: a pixel above `high` is a **strong** edge pixel, always an edge. A pixel above `low`, but not above `high`, is **weak**: it may be an edge.
#
# **Predict**: `low` is 50, `high` is 150. How many of these six magnitudes are weak: 20, 50, 51, 150, 151, 400?

# %% role="predict"
guess_weak = None  # your guess: how many?

# %%
six = np.array([[20, 50, 51],
                [150, 151, 400]])
above_low = six > 50
above_high = six > 150
print("above low, not above high")
print(above_low & ~above_high)
compare_guess(guess_weak, (above_low & ~above_high).sum())

# %% [markdown]
# *Above* means strictly above, so only 51 and 150 are weak. The same for the camera frame:

# %%
strong = stages.thinned > 150
weak = (stages.thinned > 50) & (stages.thinned <= 150)
print("weak", weak.sum(), "  strong", strong.sum())
show([weak | strong, strong], ["weak or strong: above 50", "strong: above 150"],
     rows=(380, 700), cols=(640, 1120), text="canny_stages/thresholds")

# %%
# Check: the results in this section
assert six[above_low & ~above_high].tolist() == [51, 150]
assert (stages.strong == strong).all() and (stages.weak == weak).all()
assert not (weak & strong).any()  # no pixel is both

# %% [markdown]
# ### Your turn: the double threshold ([[minutes]])
#
# Write `double_threshold(thinned, low, high)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `thinned`: (height, width) int32; `low`, `high`: two numbers, low < high | `weak, strong`, in this order: two bool arrays of the same shape | `weak, strong = double_threshold(six, 50, 150)` |
#
# Both arrays must be bool: only a bool array selects pixels.

# %% role="exercise"
exercise(
    "canny-thresholds",
    title="The double threshold",
    function="double_threshold",
    time_limit=5,
    allowed=("scipy",),
    hint="A comparison of an array with a number gives a bool array. Combine two bool arrays with & (and).",
    hints=(
        "A comparison such as thinned > high gives True or False for every pixel at once. Which two comparisons make a pixel weak?",
        "1. strong is one comparison.\n2. weak needs two comparisons: above low, and not above high.\n3. Put each of them in parentheses, and combine them with &.\n4. Return weak first, then strong.",
        "strong = thinned > high\nweak = (thinned > low) & (?)\nreturn weak, strong",
    ),
    explanation="A comparison of an array with a number gives a bool array, so no loop is needed. & combines two bool arrays pixel by pixel; it needs the parentheses, because Python computes & before > and <=. A value equal to high is not above high, so it is weak.",
    another_way="You can also write weak = (thinned > low) & ~strong, because ~ turns True into False and False into True.",
)

# %% role="answer"
def double_threshold(thinned, low, high):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & (thinned <= high)
    return weak, strong


# %% role="check"
check("canny-thresholds", double_threshold)

# %% role="case" title="values equal to a threshold" points=1 hint="For each framed value ask: is it above low? Is it above high? A value equal to a threshold is not above it."
def inputs(rng):
    low, high = int(rng.integers(20, 45)), int(rng.integers(160, 200))
    values = np.array([0, low - 1, low, low + 1, high - 1, high, high + 1, 400, 5], np.int32)
    return rng.permutation(values).reshape(3, 3), low, high


# %% role="hidden" title="any magnitudes" points=1 hint="A pixel is weak, strong or neither, but never both."
def inputs(rng):
    return rng.integers(0, 300, size=(8, 9)).astype(np.int32), 60, 180


# %% [markdown]
# ## 9 · Edge tracking by hysteresis ([[minutes]])
#
# **Pause?** Afterwards choose **Run → Run All Above Selected Cell**.
#
# A weak pixel becomes an edge if one of its eight neighbours, corners included, is an edge: this is *8-connectivity*. So edges grow from the strong pixels along the weak ones. This is **[[term:hysteresis|edge tracking by hysteresis]]**: an edge needs the high threshold to start, but only the low one to continue. Pixels that touch form a **[[term:connected component]]**: if one of them is strong, all become edges.

# %% [markdown]
# ### One step of growth ([[minutes]], deeper)
#
# The next cell defines one step of growth. `near_edge` is True where at least one of nine shifted copies of the image is.

# %%
def grow_once(edges, weak):
    height, width = edges.shape
    padded = np.pad(edges, 1)  # False around the image
    near_edge = np.zeros_like(edges)
    for row in range(3):
        for col in range(3):
            shifted = padded[row : row + height, col : col + width]
            near_edge = near_edge | shifted
    return edges | (weak & near_edge)  # already an edge, or weak and near one


# %%
def grow_steps(weak, strong, steps):
    edges = strong
    for _ in range(steps):
        edges = grow_once(edges, weak)
    return edges

# %% [markdown]
# Try it on a small image. S is a strong pixel, w is a weak pixel, a dot is background:
#
# ```
# S w w . . w
# . . . w . w
# w . . . . .
# ```
#
# **Predict** how many pixels are edges in the end, the S included.

# %% role="predict"
guess_edges = None  # your guess: how many pixels?

# %%
rows = ["Sww..w",
        "...w.w",
        "w....."]
letters = np.array([list(row) for row in rows])  # list("Sw") is ["S", "w"]
for steps in range(4):
    print("after", steps, "steps")
    grown = grow_steps(letters == "w", letters == "S", steps)
    print(np.where(grown, "E", letters))
small_edges = grow_steps(letters == "w", letters == "S", 10)
compare_guess(guess_edges, small_edges.sum())

# %%
# Check: the numbers in this section
assert small_edges.astype(int).tolist() == [[1, 1, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 0, 0]]
assert (grow_steps(letters == "w", letters == "S", 3) == small_edges).all()

# %% [markdown]
# The w in the middle row touches an edge at a corner. The other three touch none. Now the camera frame: move the slider, the number of steps, and watch the lines grow.

# %% tags=["nbval-ignore-output"]
def growth(frame, steps=0):
    edges = grow_steps(stages.weak, stages.strong, steps)
    return np.where(edges, 255, 0).astype(np.uint8)


growing = tune(growth, gray, steps=(0, 60), text="canny_stages/growth")

# %%
# Check: the first and the last image
assert (growth(gray) == np.where(stages.strong, 255, 0)).all()
assert (growth(gray, 400) == stages.edges).all()

# %% [markdown]
# ## 10 · Your turn: hysteresis ([[minutes]], deeper)
#
# Write `grow(weak, strong)`. Every strong pixel is an edge. A weak pixel is an edge if a chain of weak pixels leads from it to a strong pixel. Each pixel of the chain touches the next one at a side or a corner.
#
# | Input | Output | Example call |
# |---|---|---|
# | `weak`, `strong`: two (height, width) bool arrays; no pixel is True in both | (height, width) uint8: 255 on edges, 0 elsewhere (the type counts) | `edges = grow(stages.weak, stages.strong)` |
#
# - Another image can need more steps than this one. So repeat the step until nothing changes.
# - If you use `grow_once`, copy its definition into the answer cell.
# - Use only NumPy; `np` is imported for you.

# %% role="exercise"
exercise(
    "canny-hysteresis",
    title="Hysteresis",
    function="grow",
    exact_type=True,
    time_limit=10,
    hint="Start with the strong pixels. Grow by one step, again and again, until the number of edge pixels stops changing.",
    border_hint="Only pixels on the border are wrong. Pad with False, so that a pixel on the border has eight neighbours too, and visit every pixel.",
    hints=(
        "grow_once of section 9 makes the edges grow by one step. How can you know that one more step changes nothing?",
        "1. Start with edges = strong.\n2. In a while loop, compute the next edges as grow_once does.\n3. If they have as many edge pixels as before, stop. Otherwise go on with the next edges.\n4. At the end, make 255 and 0 of True and False.",
        "Copy grow_once into the answer cell. Then, in grow:\n    edges = strong\n    while True:\n        larger = grow_once(edges, weak)\n        if larger.sum() == ?:\n            return np.where(edges, 255, 0).astype(np.uint8)\n        edges = larger",
    ),
    explanation="Edges only grow: a step never removes an edge pixel. So if the number of edge pixels stays the same, the edges are the same, and the loop stops. larger is a new array in each step; if the loop wrote into edges itself, it would have nothing to compare with, and it would change the input strong.",
    another_way="You can also keep a list of edge pixels to visit: take one pixel from the list, and add each of its weak neighbours that is not an edge yet.",
)


def some_components(rng):
    """Nobody can know this answer before: a constant passes the other call of a case."""
    weak = rng.random((8, 9)) < 0.4
    strong = weak & (rng.random((8, 9)) < 0.15)
    return weak & ~strong, strong


def snake(size):
    """A chain of pixels through a square image, and its first row."""
    chain = np.zeros((size, size), dtype=bool)
    chain[0::2] = True
    chain[1::4, -1] = True
    chain[3::4, 0] = True
    return chain


# %% role="answer"
def grow(weak, strong):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def grow_once(edges, weak):
    height, width = edges.shape
    padded = np.pad(edges, 1)
    near_edge = np.zeros_like(edges)
    for row in range(3):
        for col in range(3):
            near_edge = near_edge | padded[row : row + height, col : col + width]
    return edges | (weak & near_edge)


def grow(weak, strong):
    edges = strong
    while True:
        larger = grow_once(edges, weak)
        if larger.sum() == edges.sum():
            return np.where(edges, 255, 0).astype(np.uint8)
        edges = larger


# %% role="check"
check("canny-hysteresis", grow)

# %% role="case" title="a chain that turns corners" points=1 hint="Every weak pixel that touches an edge at a side or a corner becomes an edge. Repeat this until nothing changes."
def inputs(rng):
    weak = np.eye(8, dtype=bool)
    weak[rng.integers(4, 7), :] = True
    weak[0, 6:] = True  # a component without a strong pixel
    strong = np.zeros_like(weak)
    strong[0, 0] = True
    return [(weak & ~strong, strong), some_components(rng)]


# %% role="case" title="a long snake" points=1 hint="A fixed number of steps is not enough for a long chain. Repeat the step until nothing changes."
def inputs(rng):
    weak = snake(9)
    strong = np.zeros_like(weak)
    strong[0, rng.integers(0, 3)] = True
    return [(weak & ~strong, strong), some_components(rng)]


# %% role="case" title="a component at each border" points=1 hint="The left border of the image does not touch the right border, and the top does not touch the bottom."
def inputs(rng):
    weak = np.zeros((7, 9), dtype=bool)
    weak[3, : rng.integers(3, 5)] = True
    weak[3, 6:] = True  # at the other end of the strong pixel's row
    weak[0, 2:5] = True
    weak[6, 2:5] = True
    weak[5, 7] = True  # touches nothing, not even across the border
    strong = np.zeros_like(weak)
    strong[3, 0] = strong[0, 3] = True
    strong[1, 7] = True  # touches no weak pixel
    return [(weak & ~strong, strong), some_components(rng)]


# %% role="case" title="a chain of more than 400 steps" points=0 hint="A fixed number of steps, such as 100 or 400, is not enough for every image. Repeat the step until nothing changes."
def inputs(rng):
    weak = snake(29)
    strong = np.zeros_like(weak)
    strong[0, rng.integers(0, 3)] = True
    return weak & ~strong, strong


# %% role="hidden" title="many components" points=1 hint="A component without a strong pixel is not an edge."
def inputs(rng):
    weak = rng.random((24, 30)) < 0.4
    strong = weak & (rng.random((24, 30)) < 0.05)
    return weak & ~strong, strong


# %% [markdown]
# ## 11 · Planned failure: Canny on a noisy frame ([[minutes]], deeper)
#
# In textbooks, the first stage of Canny is a Gaussian blur: each pixel becomes a weighted mean of its neighbours. `cv2.Canny` does **not** blur. We add Gaussian noise to the frame: a random number for each pixel, with a standard deviation (the usual size) of 15 gray levels.
#
# **Predict**: how many times as many edge pixels are there with noise?

# %% role="predict"
guess_times = None  # your guess: 1, 2, 4 or 8 times as many?

# %%
noisy = add_gaussian_noise(gray, 15, seed=1)
clean_edges, unblurred = canny(gray, 50, 150), canny(noisy, 50, 150)
show([clean_edges, unblurred], ["edges of the frame", "edges with noise"],
     text="canny_stages/noise")
times = (unblurred > 0).sum() / (clean_edges > 0).sum()
compare_guess(guess_times, round(float(times)), "times")

# %% [markdown]
# **Repair it**: blur first. `sigma` is the standard deviation of the Gaussian kernel in pixels. The step at a strong outline stays large enough; weak outlines are lost.

# %%
repaired = canny(noisy, 50, 150, sigma=2)
show([unblurred, repaired], ["without blur", "sigma = 2 pixels"],
     text="canny_stages/repaired")

# %%
# Check: the results in this section
assert round(times) == 8 and (repaired > 0).sum() < (unblurred > 0).sum() / 3
near_clean = gaussian_blur(clean_edges, 0, size=3) > 0
assert near_clean[repaired > 0].mean() > 0.9  # hardly any edge of the noise is left
assert (gaussian_blur(repaired, 0, size=3) > 0)[stages.thinned > 400].mean() > 0.9
assert (repaired > 0).sum() < (clean_edges > 0).sum() / 2
assert (repaired == canny(gaussian_blur(noisy, 2), 50, 150)).all()

# %% [markdown]
# ## 12 · Tune the three numbers ([[minutes+4]], deeper)
#
# Move the sliders. Find values that keep the outlines of the ball, the chair and the marker, but remove the wood pattern of the floor. Below the sliders is a line of code with your values that you can copy.

# %% tags=["nbval-ignore-output"]
tuner = tune(canny, gray, thresholds=(0, 1020), sigma=(0, 5.0),
             text="canny_stages/tuner")

# %%
# Check: the sliders' image
assert tuner.value.shape == gray.shape

# %% [markdown]
# ### A photograph ([[minutes]], deeper)
#
# The same on a photograph of a cat, one of scikit-image's example images (CC0, free to use). In scikit-image the first channel is red, so `[:, :, ::-1]` reverses the channels.

# %%
from skimage import data

cat = to_gray(data.chelsea()[:, :, ::-1])
cat_edges, blurred_edges = canny(cat, 50, 150), canny(cat, 50, 150, sigma=2)
show([cat, cat_edges, blurred_edges], ["photograph", "sigma = 0", "sigma = 2"],
     text="canny_stages/cat")

# %%
# Check: the results in this section
assert (cat_edges == cv2.Canny(cat, 50, 150)).all()

# %% [markdown]
# ## Recap
#
# Canny computes the gradient, thins its ridges, and keeps the strong pixels and the weak ones connected to them. It does not blur: blur a noisy image first. Each stage has the shape of the frame, (720, 1280).
#
# | stage | dtype | range | unit |
# |---|---|---|---|
# | *gray* | uint8 | 0 to 255 | gray level |
# | grad_row, grad_col | int32 | −1020 to 1020 | Sobel response (4 h at a straight step of h) |
# | magnitude (L1), thinned | int32 | 0 to 1530 | Sobel response |
# | weak, strong | bool | False, True | yes or no |
# | edges | uint8 | 0 and 255 | no and yes |
#
# **Next:** [[edge_detection_node]].

# %%
# Check: the numbers in the table
strongest = np.array([[0, 0, 0], [0, 0, 255], [0, 255, 255]], np.uint8)  # no window has a larger L1 norm
assert 4 * 255 == 1020 and magnitude(*sobel(strongest))[1, 1] == 6 * 255 == 1530
for field in ("grad_row", "grad_col", "magnitude", "thinned", "weak", "strong", "edges"):
    assert getattr(stages, field).shape == (720, 1280)
