# ---
# jupyter:
#   imgproc_course:
#     title: Grayscale
#     minutes: 50
# ---

# %% [markdown]
# # 03 · Grayscale
#
# Three numbers a pixel become one. It sounds like a division by three. It is not, and the way to the right answer leads past the trap that catches nearly everybody who computes with pixels.
#
# **You will be able to**
# - say why green counts for more than blue, and compute *luma* by hand,
# - compute with `uint8` pixels without falling over their edge,
# - do it in whole numbers only, and agree with OpenCV on every pixel,
# - say what gray cannot keep.
#
# **Time** about 50 minutes. **You need** lesson 02: a frame is an array (rows, columns, channels), blue first.

# %% role="given" exercise=["grayscale-luma"]
import numpy as np

# %%
import cv2

from imgproc_course.display import show
from imgproc_course.exercises import check
from imgproc_course.imaging import average_gray, lightness_gray, linear_light, linear_light_gray, to_gray
from imgproc_course.recording import open_recording

frame = open_recording("drive").frame(30)
print("frame", frame.shape, frame.dtype, "range", frame.min(), "to", frame.max())

# %% [markdown]
# ## 1 · One pixel (5 minutes)
#
# **Ask.** A pixel is blue 30, green 60, red 220. How bright is it? The plainest answer is the average of the three.
#
# **Predict** it in your head, then run the cell.

# %%
blue, green, red = 30, 60, 220
average = (blue + green + red) // 3
print("average:", average)

assert average == 103

# %% [markdown]
# ## 2 · Planned failure: the sum that ran over (7 minutes)
#
# Now the same pixel as it stands in a frame: three numbers of dtype `uint8`. **Predict** what comes out.

# %%
pixel = np.array([30, 60, 220], dtype=np.uint8)
wrapped = (pixel[:1] + pixel[1:2] + pixel[2:3]) // 3
print("sum:", (pixel[:1] + pixel[1:2] + pixel[2:3])[0], "  a third of it:", wrapped[0])

assert wrapped[0] == 18

# %% [markdown]
# 18 instead of 103, and not a word of warning. A `uint8` ends at 255 and then begins again at 0: 30 + 60 + 220 = 310 becomes 310 − 256 = 54, and a third of that is 18.
#
# Look at what that does to a whole frame:

# %%
wrong = (frame[..., 0] + frame[..., 1] + frame[..., 2]) // 3
right = (frame.astype(np.uint16).sum(axis=-1) // 3).astype(np.uint8)
show([wrong, right], ["added as uint8", "widened first"], encoding="mono8",
     caption="No pixel on the left is above 85, and bright walls are dark: this is what uint8 wrap-around looks like.",
     alt="Two gray pictures of the living room: the left one dark with contour-like bands, the right one natural.")

assert wrong.max() == 85
assert round((wrong != right).mean() * 100) == 92  # percent of the pixels

# %% [markdown]
# **Repair it**, always in this order: *widen, compute, round, narrow*. `astype(np.uint16)` widens to a type that ends at 65535; the last step back to `uint8` comes when the values fit again.

# %%
wide = pixel.astype(np.uint16)
repaired = np.uint8(wide.sum() // 3)
print("widened:", wide.sum(), "  a third of it:", repaired, repaired.dtype)

assert repaired == average

# %% [markdown]
# ## 3 · Your eye is no calculator (7 minutes)
#
# Is the average right? Here are pure blue, green and red, each at full strength, beside what three rules make of them. **Predict** which colour looks brightest to *you*.

# %%
patches = np.zeros((2, 6, 3), dtype=np.uint8)
patches[:, 0:2, 0] = patches[:, 2:4, 1] = patches[:, 4:6, 2] = 255
shown = [patches, average_gray(patches), lightness_gray(patches), to_gray(patches)]
show(shown, ["colour", "average", "lightness", "luma"], numbers=False,
     caption="Average and lightness make them equally bright; luma keeps green bright and blue dark, as eyes do.",
     alt="Four strips: blue, green and red; two strips of one gray; and a strip dark, bright, middle.")

print("average  ", average_gray(patches)[0, ::2])
print("lightness", lightness_gray(patches)[0, ::2])
print("luma     ", to_gray(patches)[0, ::2])
assert to_gray(patches)[0, ::2].tolist() == [29, 150, 76]

# %% [markdown]
# Eyes take most of their brightness from green and little from blue. Television engineers measured it and wrote the weights down (ITU-R BT.601); the weighted sum is called **luma**:
#
# $$Y = 0.299\,R + 0.587\,G + 0.114\,B$$
#
# **Predict** the luma of our pixel (blue 30, green 60, red 220): nearer to 103, or not?

# %%
weighted = 0.299 * red + 0.587 * green + 0.114 * blue
print("luma:", round(weighted, 2), "-> rounded", round(weighted))

assert round(weighted) == 104

# %% [markdown]
# ## 4 · In whole numbers (8 minutes)
#
# A robot's small processor likes whole numbers, and whole numbers have no rounding surprises. So multiply the weights by 2¹⁵ = 32768, round them, and divide at the end. Dividing by 2¹⁵ is a shift by 15 bits, `>> 15`.

# %%
weights = np.array([0.114, 0.587, 0.299])  # blue, green, red
whole = np.rint(weights * 2**15).astype(int)
print("weights:", whole, "  their sum:", whole.sum(), "  2**15:", 2**15)

assert whole.tolist() == [3736, 19235, 9798] and whole.sum() == 2**15 + 1

# %% [markdown]
# Rounded, they add up to one too many, and the weights of a mean must add up to exactly one. OpenCV takes the one from blue, which counts least: 3735, 19235, 9798.
#
# One thing is left. `>> 15` drops the rest: 104.76 becomes 104. To *round*, add half of 32768 first.

# %%
total = 33 * 3735 + 60 * 19235 + 220 * 9798  # a pixel like ours, a little more blue
print("as a fraction:", round(total / 2**15, 2))
print("dropped:", total >> 15, "  rounded:", (total + 2**14) >> 15)

assert 3735 + 19235 + 9798 == 2**15 == 32768
assert round(total / 2**15, 2) == 104.76 and total >> 15 == 104 and (total + 2**14) >> 15 == 105

# %% [markdown]
# Does the half matter? **Predict** on how much of the frame truncating and rounding differ: 1 %, 10 %, 50 %?

# %%
wide = frame.astype(np.uint32)
sums = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
truncated, rounded = sums >> 15, (sums + 2**14) >> 15
print(f"truncating differs from rounding on {(truncated != rounded).mean():.0%} of the pixels")

assert round((truncated != rounded).mean() * 100) == 53

# %% [markdown]
# On more than half of them, by one gray level. Nobody sees it; but an edge threshold that a pixel just misses does.
#
# ## 5 · A picture small enough to read (4 minutes)

# %%
tiny = frame[386:391, 449:454]
show([tiny, to_gray(tiny)], ["blue, green, red", "luma"], encoding=["bgr8", "mono8"],
     caption="Five by five pixels of the ball's red stripe: check one of them by hand.",
     alt="A grid of coloured squares with three numbers each, and the same grid in gray with one.")

b, g, r = (int(value) for value in tiny[2, 2])
by_hand = (b * 3735 + g * 19235 + r * 9798 + 2**14) >> 15
print(f"by hand: ({b} * 3735 + {g} * 19235 + {r} * 9798 + 16384) >> 15 = {by_hand}")
assert to_gray(tiny)[2, 2] == by_hand

# %% [markdown]
# ## 6 · Does OpenCV agree? (4 minutes)
#
# Three ways: our sum above, the course's `to_gray`, and OpenCV's `cvtColor`. **Check** every pixel of the frame.

# %%
gray = to_gray(frame)
opencv = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
print("gray", gray.shape, gray.dtype, "range", gray.min(), "to", gray.max())
print("pixels that differ from OpenCV:", int((gray != opencv).sum()), "of", gray.size)

assert (gray == opencv).all() and (rounded == opencv).all()

# %%
show([frame, gray], ["frame", "gray (luma)"], encoding=["bgr8", "mono8"],
     caption="One number a pixel instead of three; shapes and shadows stay.",
     alt="The living room with the walking person, in colour and in shades of gray.")

# %% [markdown]
# And once on a photograph: a cup of coffee, a picture that comes with scikit-image and is in the public domain (CC0). Photographs in files are mostly red first, so the channels are turned around before `to_gray` sees them.

# %%
from skimage import data

coffee = data.coffee()[..., ::-1]
coffee_gray = to_gray(coffee)
show([coffee, coffee_gray], ["photograph", "gray (luma)"], encoding=["bgr8", "mono8"],
     caption="Saucer, table and coffee can still be told apart in gray, because their luma differs.",
     alt="A cup of coffee on a table, in colour and in gray.")

assert (coffee_gray == cv2.cvtColor(np.ascontiguousarray(coffee), cv2.COLOR_BGR2GRAY)).all()

# %% [markdown]
# ## 7 · Whose weights? (3 minutes)
#
# If somebody hands you `rgb8` and you take it for `bgr8`, blue gets red's weight. The picture still looks like a good gray picture. **Predict** how far it is off.

# %%
swapped = to_gray(frame[..., ::-1])
off = np.abs(swapped.astype(np.int16) - gray)
print("mean difference:", round(float(off.mean()), 1), "  largest:", off.max(), "gray levels")

assert round(float(off.mean()), 1) == 8.6 and off.max() == 38

# %% [markdown]
# Too little to see, and enough to move edges. Only the message's `encoding` tells you; your eye does not.
#
# ## 8 · What gray cannot keep (3 minutes)
#
# Two colours can have the same luma. Then gray cannot tell them apart, and no edge will ever be found between them.

# %%
pair = np.zeros((4, 8, 3), dtype=np.uint8)
pair[:, :4] = (40, 100, 60)   # a green
pair[:, 4:] = (200, 10, 175)  # a violet
print("luma left and right:", to_gray(pair)[0, 0], to_gray(pair)[0, -1])
show([pair, to_gray(pair)], ["two colours", "one gray"], encoding=["bgr8", "mono8"], numbers=False,
     caption="A green and a violet of equal luma: in gray the border between them is gone.",
     alt="Left, a green and a violet half; right, one even gray.")

assert to_gray(pair)[0, 0] == to_gray(pair)[0, -1]

# %% [markdown]
# ## 9 · What the numbers are not: light (5 minutes)
#
# Is a pixel of 200 twice as bright as one of 100? **Predict**, then look. A camera does not store the amount of light. It stores a *gamma-coded* number, which spends more of its 256 levels on dark tones, where eyes are keen. The sRGB standard says how to get back to the light.

# %%
light = linear_light(np.array([50, 100, 200, 255], dtype=np.uint8))
print("share of full light at levels 50, 100, 200, 255:", light.round(3))
print("light at 200 over light at 100:", round(float(light[2] / light[1]), 1))

assert light.round(3).tolist() == [0.032, 0.127, 0.578, 1.0]
assert round(float(light[2] / light[1]), 1) == 4.5

# %% [markdown]
# Twice the number is four and a half times the light. Luma is a weighted mean of the *numbers*; the true brightness, *luminance*, is a weighted mean of the *light*. On gray and pale colours the two agree, on strong ones they do not:

# %%
by_light = linear_light_gray(patches)
print("luma             ", to_gray(patches)[0, ::2], " (blue, green, red)")
print("luminance, coded ", by_light[0, ::2])
show([patches, to_gray(patches), by_light], ["colour", "luma", "luminance"], numbers=False,
     caption="Weighing light instead of numbers makes pure colours brighter; on white walls nothing changes.",
     alt="Three strips: blue, green and red; their luma; their luminance, which is brighter.")

white_wall = np.full((1, 1, 3), 200, np.uint8)
assert (by_light >= to_gray(patches)).all() and linear_light_gray(white_wall) == to_gray(white_wall) == 200

# %% [markdown]
# Robots use luma all the same: it costs three multiplications, and it is what OpenCV gives. But never average *pictures* to measure light without undoing gamma first.
#
# ## 10 · Your turn: luma in whole numbers (8 minutes)
#
# Write `luma(bgr)`. It gets a frame, (height, width, 3) uint8, blue first, and gives back its luma, (height, width) uint8, rounded, with the weights of section 4. Whole numbers are the safe way. `cv2` and the course's own functions are refused.

# %% role="exercise"
exercise(
    "grayscale-luma",
    title="Luma in whole numbers",
    function="luma",
    time_limit=5,
    refused=("cv2", "imgproc_course.imaging"),
    hint="Widen, compute, round, narrow: in that order.",
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


# %% role="case" title="dark colours" points=1 hint="Which channel comes first, and which weight belongs to it?"
def inputs(rng):
    return (rng.integers(0, 60, size=(4, 5, 3), dtype=np.uint8),)


# %% role="case" title="bright colours" points=1 hint="uint8 ends at 255: widen before you add or multiply."
def inputs(rng):
    return (rng.integers(150, 256, size=(4, 5, 3), dtype=np.uint8),)


# %% role="case" title="many colours" points=1 hint="Which weights did OpenCV take? The three must add up to 32768."
def inputs(rng):
    return (rng.integers(0, 256, size=(48, 64, 3), dtype=np.uint8),)


# %% role="hidden" title="a larger picture" points=1 hint="Is every value rounded, not cut off? Add half before you shift."
def inputs(rng):
    return (rng.integers(0, 256, size=(48, 64, 3), dtype=np.uint8),)


# %% role="hidden" title="black, white and pure colours" points=1 hint="White must stay 255 and black 0."
def inputs(rng):
    corners = np.array([[b, g, r] for b in (0, 255) for g in (0, 255) for r in (0, 255)], dtype=np.uint8)
    return (rng.permutation(corners).reshape(2, 4, 3),)


# %% role="mistake" name="uint8 wraps" says="This is what uint8 wrap-around looks like: the sum ran past 255 and began again at 0. Widen (astype) before you add."
def luma(bgr):
    b, g, r = bgr[..., 0], bgr[..., 1], bgr[..., 2]
    return (b + g + r) // np.uint8(3)


# %% role="mistake" name="the weights are swapped" says="Blue got red's weight: the channels come blue, green, red, so the weights are 3735, 19235, 9798 in that order."
def luma(bgr):
    wide = bgr.astype(np.uint32)
    total = wide[..., 2] * 3735 + wide[..., 1] * 19235 + wide[..., 0] * 9798
    return ((total + 2**14) >> 15).astype(np.uint8)


# %% role="mistake" name="cut off instead of rounded" says="The values are cut off, not rounded: add one half before you narrow (in whole numbers: 2**14 before >> 15)."
def luma(bgr):
    wide = bgr.astype(np.uint32)
    total = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
    return (total >> 15).astype(np.uint8)


# %% role="mistake" name="the plain average" says="That is the average of the three channels. Luma weighs them: green counts most, blue least."
def luma(bgr):
    return (bgr.astype(np.uint32).sum(axis=-1) // 3).astype(np.uint8)


# %% role="mistake" name="not narrowed" says="The values are right, but the dtype is not uint8: narrow at the end with astype(np.uint8)."
def luma(bgr):
    wide = bgr.astype(np.uint32)
    return (wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798 + 2**14) >> 15


# %% [markdown]
# ## Recap
#
# Luma weighs green most and blue least. Widen, compute, round, narrow: in that order, and the answer is OpenCV's, bit for bit.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *frame* | (720, 1280, 3) | uint8 | 0 to 255 | gray level of blue, green, red |
# | widened | (720, 1280, 3) | uint32 | 0 to 255 | gray level |
# | weighted sum | (720, 1280) | uint32 | 0 to 8,355,840 | 1/32768 gray level |
# | *gray* | (720, 1280) | uint8 | 0 to 255 | gray level (luma) |

# %%
assert 255 * 2**15 == 8_355_840
assert wide.dtype == sums.dtype == np.uint32 and sums.shape == (720, 1280)
assert gray.shape == (720, 1280) and gray.dtype == np.uint8
