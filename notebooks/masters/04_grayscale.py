# ---
# jupyter:
#   imgproc_course:
#     title: Grayscale
# ---

# %% [markdown]
# # Grayscale
#
# A colour image has three numbers per pixel. A gray image has one: the *intensity* of the pixel, or *gray level*. It is not the average of the three. Here you learn the right formula, and meet a mistake that nearly everybody makes at first.
#
# **You will be able to**
# - explain why the channels have different weights, and compute *luma* (the gray level that OpenCV uses) by hand,
# - calculate with `uint8` pixels without overflow,
# - compute luma with integers, and get the same result as OpenCV for every pixel.
#
# **Time** [[minutes]]. **You need** [[arrays]] (index, slice, dtype) and [[images_as_messages]]: the channels of a frame are in the order blue, green, red.

# %% role="given" exercise=["grayscale-luma"]
import numpy as np

# %%
import cv2

from imgproc_course.display import show
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.imaging import average_gray, lightness_gray, to_gray
from imgproc_course.recording import open_recording

frame = open_recording("drive").frame(30)
print("frame", frame.shape, frame.dtype)
print("range", frame.min(), "to", frame.max())

# %% role="texts"
figure_texts = {
    "overflow": (
        "On the left, no pixel is above 85, and bright walls look dark: this is the effect of uint8 overflow.",
        "Two gray images of the living room: the left one is dark and has stripes where the intensity changes slowly, the right one looks natural.",
    ),
    "methods": (
        "Average and lightness give all three the same gray level. Luma makes green bright and blue dark, as your eyes see them.",
        "Four strips: blue, green and red; two strips of one gray; and a strip with a dark, a bright and a middle gray.",
    ),
    "tiny": (
        "Five by five pixels of the ball's red stripe. Below the figure, the middle pixel is computed by hand.",
        "A grid of coloured squares with three numbers each, and the same grid in gray with one number each.",
    ),
    "frame": (
        "The gray image has one number per pixel instead of three, but shapes and shadows are still visible.",
        "The living room with the walking person, in colour and in shades of gray.",
    ),
}

# %% [markdown]
# ## 1 · One pixel ([[minutes]])
#
# A pixel has three channels: blue 30, green 60, red 220. How bright is it? The simplest answer is the average.
#
# **Predict** the average. Write your guess instead of `None`.

# %% role="predict"
guess_average = None  # your guess: which number?

# %%
blue, green, red = 30, 60, 220
average = (blue + green + red) // 3  # // divides and rounds down
compare_guess(guess_average, average)

# %%
# Check: the numbers in this section
assert average == 103

# %% [markdown]
# ## 2 · Planned failure: a sum of pixels ([[minutes]])
#
# Now the same pixel as in a frame: three numbers of dtype `uint8`. **Predict** the result.

# %% role="predict"
guess_wrapped = None  # your guess: which number?

# %%
blue_pixels = np.array([30], dtype=np.uint8)  # arrays with one pixel each
green_pixels = np.array([60], dtype=np.uint8)
red_pixels = np.array([220], dtype=np.uint8)
total = blue_pixels + green_pixels + red_pixels
wrapped = total // 3
print("sum:", total[0])
compare_guess(guess_wrapped, wrapped[0])

# %% [markdown]
# The result is 18 instead of 103, and NumPy does not warn you: 30 + 60 + 220 = 310 became 310 − 256 = 54, and a third of 54 is 18. After 255 a `uint8` starts again at 0. This is called *[[term:overflow]]*, or *wrap-around*.
#
# Here is the effect on a whole frame. `frame[..., 0]` is the blue channel of every pixel.

# %%
wrong = (frame[..., 0] + frame[..., 1] + frame[..., 2]) // 3
wide = frame.astype(np.uint16)
right = (wide[..., 0] + wide[..., 1] + wide[..., 2]) // 3
show([wrong, right.astype(np.uint8)], ["added as uint8", "widened first"],
     encoding="mono8", text="grayscale/overflow")

# %% [markdown]
# **Repair it** in four steps, always in this order: *widen, compute, round, narrow*. To *widen* is to convert to a larger type: `astype(np.uint16)` gives a type that holds numbers up to 65,535. To *narrow* is to convert back to `uint8`. (Here `//` rounds down.)

# %%
wide = blue_pixels.astype(np.uint16) + green_pixels + red_pixels
repaired = (wide // 3).astype(np.uint8)
print("sum:", wide[0], wide.dtype, "  a third:", repaired[0], repaired.dtype)

# %% [markdown]
# The rule: ask for the *largest* number that can occur, and choose a dtype that holds it.

# %%
# Check: the numbers in this section
assert total[0] == 54 and wrapped[0] == 18 and 30 + 60 + 220 == 310
assert wrong.max() == 85
assert repaired[0] == average == 103
assert np.iinfo(np.uint16).max == 65_535

# %% [markdown]
# ### Is uint16 large enough? ([[minutes]], deeper)
#
# Later we multiply pixels by numbers such as 19235. **Predict** the product of a white pixel, 255, and 19235 in `uint16`: is it right?

# %% role="predict"
guess_product = None  # your guess: is the product right, "yes" or "no"?

# %%
white = np.array([255], dtype=np.uint16)
print("uint16:", (white * 19235)[0])
print("uint32:", (white.astype(np.uint32) * 19235)[0])
compare_guess(guess_product, int((white * 19235)[0]) == 255 * 19235)

# %% [markdown]
# The product is 4,904,925. It does not fit into `uint16`, but into `uint32`, which holds numbers up to 4,294,967,295.

# %% [markdown]
# One more trap, with the index. **Predict** the shape of `frame[0]`: is it the blue channel?

# %% role="predict"
guess_shape = None  # your guess: the shape of frame[0], such as (720, 1280)?

# %%
print("frame[..., 0]:", frame[..., 0].shape)
compare_guess(guess_shape, frame[0].shape)

# %% [markdown]
# `frame[0]` is the first *row* of the image: 1280 pixels with three channels. The channels are on the *last* axis, so the blue channel is `frame[..., 0]`.

# %%
# Check: the product and the shapes
assert frame[0].shape == (1280, 3) and frame[..., 0].shape == (720, 1280)
assert np.iinfo(np.uint32).max == 4_294_967_295
assert 255 * 19235 == 4_904_925 and (white * 19235)[0] == 4_904_925 % 65_536

# %% [markdown]
# ## 3 · Your eyes do not compute the average ([[minutes]])
#
# Is the average right? We make three patches: pure blue, green and red.

# %%
patches = np.zeros((2, 6, 3), dtype=np.uint8)
patches[:, 0:2, 0] = 255  # two columns of pure blue,
patches[:, 2:4, 1] = 255  # two of pure green,
patches[:, 4:6, 2] = 255  # and two of pure red

# %% [markdown]
# The cell below your guess draws them and the results of three methods: the *average*; the *[[term:lightness]]* (the mean of the largest and the smallest channel); and *luma*, explained below. **Predict** which colour looks brightest to *you*.

# %% role="predict"
guess_brightest = None  # your guess: "blue", "green" or "red"?

# %%
luma_patches = to_gray(patches)
strips = [patches, average_gray(patches), lightness_gray(patches), luma_patches]
show(strips, ["colour", "average", "lightness", "luma"], numbers=False,
     text="grayscale/methods")
largest = luma_patches[0, ::2].argmax()  # the position of the largest value
compare_guess(guess_brightest, ["blue", "green", "red"][largest])

# %%
print("blue, green, red:")
print("average  ", average_gray(patches)[0, ::2])  # row 0, every second column
print("lightness", lightness_gray(patches)[0, ::2])
print("luma     ", luma_patches[0, ::2])

# %% [markdown]
# For human eyes, green contributes most to the brightness, and blue contributes little.
#
# A television standard (ITU-R BT.601) defines three weights from measurements. The weighted sum is called **[[term:luma]]**:
#
# $$Y = 0.299\,R + 0.587\,G + 0.114\,B$$
#
# The weights add up to 1, so white stays white. **Predict** the luma of our pixel (blue 30, green 60, red 220).

# %% role="predict"
guess_luma = None  # your guess: which number?

# %%
weighted = 0.299 * red + 0.587 * green + 0.114 * blue
print("luma before rounding:", round(weighted, 2))
compare_guess(guess_luma, round(weighted))

# %%
# Check: the numbers in this section
assert luma_patches[0, ::2].tolist() == [29, 150, 76]
assert round(weighted) == 104 and round(0.299 + 0.587 + 0.114, 9) == 1

# %% [markdown]
# ## 4 · With integers ([[minutes]])
#
# On a small processor, calculations with integers are fast, and their sums have no rounding errors. So we multiply the weights by 2¹⁵ = 32768, round them, and divide the sum by 2¹⁵ at the end.

# %%
weights = np.array([0.114, 0.587, 0.299])  # blue, green, red
integer_weights = np.rint(weights * 2**15).astype(int)  # rint: nearest integer
print("weights:", integer_weights, "  their sum:", integer_weights.sum())
print("2**15:", 2**15)

# %% [markdown]
# The sum of the rounded weights is 32769, one more than 2¹⁵, so the result would be a little too large. OpenCV subtracts 1 from the smallest weight. So its weights are 3735, 19235 and 9798.
#
# `>> 15` (a shift by 15 bits) is a fast way to write `// 2**15`. Like `//`, it *[[term:truncate|truncates]]*: it drops the fraction. To *round* to the nearest integer, add half of 32768 (2¹⁴ = 16384) first. For one pixel, sum / 2¹⁵ is 104.76. **Predict** both results.

# %% role="predict"
guess_both = None  # your guess: truncated and rounded, such as (7, 8)?

# %%
total = 33 * 3735 + 60 * 19235 + 220 * 9798  # blue 33, green 60, red 220
print("exact:", round(total / 2**15, 2))
compare_guess(guess_both, (total >> 15, (total + 2**14) >> 15))

# %% [markdown]
# Python computes `+` before `>>`.
#
# Now the whole frame. 255 × 19235 = 4,904,925 does not fit into `uint16`, so we widen to `uint32`, which holds numbers up to 4,294,967,295.
#
# Is it important to round? **Predict** for how many pixels of the frame the truncated and the rounded value differ: 1 %, 10 % or 50 %?

# %% role="predict"
guess_percent = None  # your guess: how many percent of the pixels?

# %%
wide = frame.astype(np.uint32)
sums = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
truncated = sums >> 15
rounded = (sums + 2**14) >> 15
compare_guess(guess_percent, round((truncated != rounded).mean() * 100), "%")

# %% [markdown]
# More than half of the pixels differ, each by one gray level. You cannot see this. But later lessons compare pixels with a threshold, and there one gray level can decide.

# %%
# Check: the numbers in this section
assert integer_weights.tolist() == [3736, 19235, 9798] and integer_weights.sum() == 2**15 + 1 == 32769
assert 3735 + 19235 + 9798 == 2**15 == 32768 and 2**14 == 16384
assert round(total / 2**15, 2) == 104.76 and total >> 15 == 104 and (total + 2**14) >> 15 == 105
assert (truncated != rounded).mean() > 0.5 and (rounded - truncated).max() == 1

# %% [markdown]
# ### Integers or decimals? ([[minutes]], deeper)
#
# The formula with 0.114, 0.587 and 0.299 is right too. But its weights are not exactly the integer weights divided by 2¹⁵. **Predict** how many of the 921,600 pixels get another gray level.

# %% role="predict"
guess_decimal = None  # your guess: how many pixels?

# %%
decimal = 0.114 * frame[..., 0] + 0.587 * frame[..., 1] + 0.299 * frame[..., 2]
other = np.rint(decimal) != rounded
print("pixels in the frame:", other.size)
compare_guess(guess_decimal, int(other.sum()))

# %%
# Check: one pixel differs
assert other.sum() == 1 and other.size == 921_600
colours = np.random.default_rng(0).integers(0, 256, (100, 100, 3), dtype=np.uint8)
decimal = 0.114 * colours[..., 0] + 0.587 * colours[..., 1] + 0.299 * colours[..., 2]
assert (np.rint(decimal) != to_gray(colours)).sum() > 1 and np.abs(np.rint(decimal) - to_gray(colours)).max() == 1

# %% [markdown]
# Only one pixel differs, by one gray level. (In an image with all kinds of colours, a few more differ.) But "equal for every pixel" is easier to check than "nearly equal". So the exercise asks for the integer weights.

# %% [markdown]
# ## 5 · An image small enough to read ([[minutes]], deeper)
#
# We cut 5 × 5 pixels out of the frame, and compute the middle one by hand. (`f"..."` is an *f-string*: Python replaces each name in braces by its value.)

# %%
tiny = frame[386:391, 449:454]
show([tiny, to_gray(tiny)], ["blue, green, red", "luma"], columns=1,
     encoding=["bgr8", "mono8"], text="grayscale/tiny")

# %%
b = int(tiny[2, 2, 0])  # the middle pixel; int() makes a Python integer of it
g = int(tiny[2, 2, 1])
r = int(tiny[2, 2, 2])
by_hand = (b * 3735 + g * 19235 + r * 9798 + 2**14) >> 15
print(f"({b} * 3735 + {g} * 19235 + {r} * 9798 + 16384) >> 15 = {by_hand}")

# %% [markdown]
# Now all pixels, with **two loops** over the rows and the columns:

# %%
height, width, channels = tiny.shape
by_loops = np.zeros((height, width), dtype=np.uint8)  # will hold the results
for row in range(height):
    for col in range(width):
        b, g, r = tiny[row, col].astype(np.uint32)
        by_loops[row, col] = (b * 3735 + g * 19235 + r * 9798 + 2**14) >> 15
print(by_loops)

# %% [markdown]
# The same **with slices**: `wide[..., 0]` is the blue channel of all pixels at once, and NumPy runs the loops for us, much faster.

# %%
wide = tiny.astype(np.uint32)
sums_tiny = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
by_slices = ((sums_tiny + 2**14) >> 15).astype(np.uint8)
print("equal:", (by_loops == by_slices).all())

# %%
# Check: the results in this section
assert tiny.shape == (5, 5, 3) and to_gray(tiny)[2, 2] == by_hand == by_loops[2, 2]
assert (by_slices == to_gray(tiny)).all() and (by_loops == by_slices).all()

# %% [markdown]
# ## 6 · Does OpenCV agree? ([[minutes]])
#
# **Pause?** Afterwards choose **Run → Run All Above Selected Cell**.
#
# We compare our rounded sum, the course's `to_gray`, and OpenCV's `cvtColor`. **Check** every pixel of the frame.

# %%
gray = to_gray(frame)
opencv = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
print("gray", gray.shape, gray.dtype, "range", gray.min(), "to", gray.max())
print("to_gray differs from OpenCV:", (gray != opencv).sum(), "pixels")
print("our sum differs from OpenCV:", (rounded != opencv).sum(), "pixels")

# %%
show([frame, gray], ["frame", "gray (luma)"],
     encoding=["bgr8", "mono8"], text="grayscale/frame")

# %%
# Check: the results in this section
assert (gray == opencv).all() and (rounded == opencv).all()

# %% [markdown]
# ## 7 · Your turn: luma with integers ([[minutes]])
#
# Write `luma(bgr)` for an image of any size. Use the integer weights of section 4, and round. Write it with slices, as in section 4, or with two loops over the pixels.
#
# | Input | Output | Example call |
# |---|---|---|
# | `bgr`: a frame, (height, width, 3) uint8, channels blue, green, red | its luma, (height, width) uint8 | `luma(frame)` equals `gray` |
#
# The dtype counts: the result must be uint8. The check refuses an answer that uses `cv2` or the course's own functions.

# %% role="exercise"
exercise(
    "grayscale-luma",
    title="Luma with integers",
    function="luma",
    exact_type=True,
    time_limit=5,
    hint="Widen, compute, round, narrow, in this order.",
    hints=(
        "Which channel is bgr[..., 0], and which weight belongs to it? And which dtype can hold 255 * 19235?",
        "1. Widen the frame with astype(np.uint32).\n"
        "2. Multiply each channel by its weight (blue 3735, green 19235, red 9798) and add the three products.\n"
        "3. Round: add 2**14, then shift with >> 15.\n"
        "4. Narrow with astype(np.uint8).",
        "wide = bgr.astype(np.uint32)\n"
        "total = wide[..., 0] * 3735 + wide[..., 1] * ... + wide[..., 2] * ...\n"
        "return ((total + ...) >> 15).astype(...)",
    ),
    explanation="astype(np.uint32) comes first, because a product such as 255 * 19235 does not fit into uint8"
    " or uint16. wide[..., 0] is the blue channel of all pixels, so one line computes the sum for the whole"
    " frame. + 2**14 makes >> 15 round to the nearest integer instead of rounding down. The parentheses are"
    " needed, because Python computes + before >>, and the result must be narrowed last.",
    border_hint="Every pixel gets its luma from its own three channels, also in the last row and the last column. Do your"
    " loops run to the end: range(height) and range(width)?",
    another_way="You can also write the sum as (wide * [3735, 19235, 9798]).sum(axis=-1), or compute it pixel by"
    " pixel in two loops over the rows and columns.",
)

# %% role="answer"
def luma(bgr):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    total = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
    return ((total + 2**14) >> 15).astype(np.uint8)

# %% role="check"
check("grayscale-luma", luma)

# %% role="case" title="dark colours" points=1 hint="Compute one pixel by hand: (blue * 3735 + green * 19235 + red * 9798 + 2**14) >> 15. Where does your function do something else?"
def inputs(rng):
    return (rng.integers(0, 60, size=(4, 5, 3), dtype=np.uint8),)

# %% role="case" title="bright colours" points=1 hint="Do all products and sums fit into their dtype? uint32 is large enough."
def inputs(rng):
    return (rng.integers(150, 256, size=(4, 5, 3), dtype=np.uint8),)

# %% role="case" title="many colours" points=1 hint="Which weights does OpenCV use? The three integers must add up to 32768."
def inputs(rng):
    image = rng.integers(0, 256, size=(48, 64, 3), dtype=np.uint8)
    image[rng.integers(48), rng.integers(64)] = [113, 121, 109]  # its luma is 116.5, exactly
    return (image,)

# %% role="hidden" title="a larger image" points=1 hint="Is every value rounded, not truncated? Add half before you shift."
def inputs(rng):
    image = rng.integers(0, 256, size=(48, 64, 3), dtype=np.uint8)
    image[0, :3] = [71, 244, 53], [128, 1, 78], [240, 159, 93]  # colours for which decimal weights give another gray level
    return (image,)

# %% role="hidden" title="black, white and pure colours" points=1 hint="White must stay 255 and black 0."
def inputs(rng):
    corners = np.array([[b, g, r] for b in (0, 255) for g in (0, 255) for r in (0, 255)], dtype=np.uint8)
    return (rng.permutation(corners).reshape(2, 4, 3),)

# %% [markdown]
# ## Recap
#
# In luma, green has the largest weight and blue the smallest. Widen, compute, round, narrow, in this order.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *frame*, widened | (720, 1280, 3) | uint8, then uint32 | 0 to 255 | gray level of blue, green, red |
# | weighted sum, before `>> 15` | (720, 1280) | uint32 | 0 to 8,355,840 | 1/32768 of a gray level |
# | *gray* | (720, 1280) | uint8 | 0 to 255 | gray level (luma) |
#
# **Next:** [[grayscale_node]].

# %%
# Check: the numbers in the table
assert 255 * 2**15 == 8_355_840
assert wide.dtype == sums.dtype == np.uint32 and sums.shape == (720, 1280)
assert gray.shape == (720, 1280) and gray.dtype == np.uint8
