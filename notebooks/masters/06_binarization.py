# ---
# jupyter:
#   imgproc_course:
#     title: Binarization
#     minutes: 45
# ---

# %% [markdown]
# # 06 · Binarization
#
# Paper or print, marker or wall, obstacle or floor: often a robot wants a yes or no for each pixel. Somewhere between black and white a line must be drawn. This lesson is about who draws it.
#
# **You will be able to**
# - make a binary picture with a threshold, and read a histogram,
# - find the threshold with Otsu's method, by hand and exactly as OpenCV does,
# - say when one threshold for the whole picture cannot work, and what does.
#
# **Time** about 45 minutes. **You need** lessons 03 and 05.

# %% role="given" exercise=["binarization-otsu"]
import numpy as np

# %%
import cv2
from matplotlib.figure import Figure

from imgproc_course.display import show, show_figure
from imgproc_course.exercises import check
from imgproc_course.imaging import adaptive_threshold, otsu_threshold, threshold, to_gray
from imgproc_course.recording import open_recording

recording = open_recording("drive")
gray = to_gray(recording.frame(30))
print("gray", gray.shape, gray.dtype, "range", gray.min(), "to", gray.max())

# %% [markdown]
# ## 1 · A line through the values (5 minutes)
#
# **Ask.** Every value above 100 becomes 255, all others become 0. **Predict** what becomes of the 100 itself in the middle.

# %%
tiny = np.array([[20, 30, 40, 180, 190],
                 [25, 35, 45, 185, 195],
                 [30, 40, 100, 190, 200],
                 [35, 45, 160, 195, 205],
                 [40, 50, 170, 200, 210]], dtype=np.uint8)
binary = np.where(tiny > 100, 255, 0).astype(np.uint8)
show([tiny, binary], ["gray", "above 100"], encoding="mono8",
     caption="Above means above: 100 itself is not above 100 and turns black.",
     alt="A five by five grid of gray numbers, and the same grid in black and white with 0 and 255.")

assert binary[2, 2] == 0 and np.unique(binary).tolist() == [0, 255]
assert (threshold(tiny, 100) == binary).all()

# %% [markdown]
# ## 2 · The histogram shows where to cut (7 minutes)
#
# The marker at the back wall is black print on white paper. A *histogram* counts for each gray level how many pixels have it. **Predict** its shape: one hill, or two?

# %%
marker = gray[319:395, 656:724]
counts = np.bincount(marker.ravel(), minlength=256)
show(marker, "the marker", encoding="mono8",
     caption="Black print on white paper, seen by the robot from 3.6 metres.",
     alt="A black square with a white pattern of bits on white paper.")

assert counts.sum() == marker.size == 76 * 68

# %%
def draw_histogram(counts, lines, title):
    figure = Figure(figsize=(8, 2.6), dpi=100, layout="constrained")
    axes = figure.add_subplot()
    axes.bar(np.arange(256), counts, width=1, color="0.35")
    for name, (value, colour) in lines.items():
        axes.axvline(value, color=colour, label=f"{name} = {value}")
    axes.set(title=title, xlabel="gray level", ylabel="pixels", xlim=(0, 255))
    axes.legend()
    return figure


show_figure(draw_histogram(counts, {"cut in the middle": (128, "tab:blue")}, "pixels of each gray level"),
            caption="Two hills, ink left and paper right; any cut in the valley between them will do.",
            alt="A histogram with one dark and one bright hill, and a blue line at 128 between them.")

# %% [markdown]
# ## 3 · Otsu's idea (8 minutes)
#
# A person sees the valley. A program needs a rule, and Otsu's (1979) is: try every threshold, and keep the one that makes the two groups differ most. How much they differ is measured by the **between-class variance**
#
# $$\sigma_B^2(t) = w_0\, w_1\, (\mu_0 - \mu_1)^2$$
#
# $w_0$ and $w_1$ are the shares of the pixels at or below $t$ and above it, $\mu_0$ and $\mu_1$ the mean gray levels of the two groups.
#
# By hand, on eight pixels and four thresholds. **Predict** which of the four wins.

# %%
eight = np.array([10, 20, 20, 30, 180, 190, 200, 210])
for t in (15, 25, 100, 195):
    low, high = eight[eight <= t], eight[eight > t]
    variance = low.size / 8 * high.size / 8 * (low.mean() - high.mean()) ** 2
    print(f"t = {t:3}   {low.size} below, {high.size} above   between-class variance {variance:8.1f}")

assert 4 / 8 * 4 / 8 * (eight[:4].mean() - eight[4:].mean()) ** 2 == 7656.25

# %% [markdown]
# The one that cuts between 30 and 180. Now all 256 thresholds of the marker, and the largest variance wins.

# %%
def between_class_variance(counts, t):
    levels = np.arange(256)
    below, above = counts[: t + 1].sum(), counts[t + 1 :].sum()
    if below == 0 or above == 0:
        return 0.0
    mean_below = (levels[: t + 1] * counts[: t + 1]).sum() / below
    mean_above = (levels[t + 1 :] * counts[t + 1 :]).sum() / above
    return below * above / counts.sum() ** 2 * (mean_below - mean_above) ** 2


variances = np.array([between_class_variance(counts, t) for t in range(256)])
best = int(np.argmax(variances))
print("best threshold:", best, "  OpenCV's:", int(cv2.threshold(marker, 0, 255, cv2.THRESH_OTSU)[0]))

assert best == otsu_threshold(marker) == int(cv2.threshold(marker, 0, 255, cv2.THRESH_OTSU)[0])

# %%
figure = Figure(figsize=(8, 3.6), dpi=100, layout="constrained")
upper, lower = figure.subplots(2, sharex=True)
upper.bar(np.arange(256), counts, width=1, color="0.35")
lower.plot(variances, color="tab:orange")
for axes in (upper, lower):
    axes.axvline(best, color="tab:red")
upper.set(ylabel="pixels", title=f"Otsu's threshold is {best}")
lower.set(xlabel="threshold t (gray level)", ylabel="between-class\nvariance (level²)", xlim=(0, 255))
show_figure(figure, caption="The curve is highest where the cut parts the two hills best: the red line marks it.",
            alt="Above, the marker's histogram; below, a curve with one broad maximum; a red line through both.")

# %%
show([marker, threshold(marker, best)], ["gray", f"above {best}"], encoding="mono8",
     caption="Ink is black, paper is white: now a program can read the marker's bits.",
     alt="The marker in gray and in pure black and white.")

# %% [markdown]
# ## 4 · Two places more (5 minutes)
#
# The same rule on the sign at the wall, and once on a photograph: a photographer with his camera, a picture that comes with scikit-image (CC0).

# %%
from skimage import data

sign = to_gray(recording.frame(75))[215:310, 660:800]
photograph = data.camera()
for name, picture in {"sign": sign, "photograph": photograph}.items():
    print(f"{name:10} Otsu's threshold {otsu_threshold(picture)}")

show([photograph, threshold(photograph, otsu_threshold(photograph))], ["photograph", "Otsu"],
     caption="The dark coat parts from the bright sky and grass: one threshold is enough here.",
     alt="A man behind a camera on a tripod, in gray and in black and white.")
assert otsu_threshold(photograph) == int(cv2.threshold(photograph, 0, 255, cv2.THRESH_OTSU)[0])

# %% [markdown]
# ## 5 · Planned failure: the sun on the floor (8 minutes)
#
# A rug with dark stripes lies half in the sun. We want the stripes. **Predict** what one threshold for all of it makes of the sunny part.

# %%
rug = gray[415:515, 60:560]
one_cut = threshold(rug, otsu_threshold(rug))
show([rug, one_cut], ["rug, partly in the sun", f"above {otsu_threshold(rug)}"], encoding="mono8", columns=1,
     caption="One threshold parts sun from shade instead of stripe from stripe.",
     alt="A striped rug with a bright sunny part; below, the sunny part is all white.")

# %% [markdown]
# What is bright? Compare a dark stripe in the sun with a bright stripe in the shade:

# %%
sunny, shady = rug[50:90, 150:250], rug[50:90, 430:500]
dark_in_sun, bright_in_shade = np.percentile(sunny, 10), np.percentile(shady, 90)
print(f"dark stripes in the sun: {dark_in_sun:.0f}   bright stripes in the shade: {bright_in_shade:.0f}")

assert round(dark_in_sun) == 188 and round(bright_in_shade) == 185

# %% [markdown]
# What is dark in the sun is brighter than what is bright in the shade: no single line parts dark from bright. **Repair it**: let each pixel be compared with *its own neighbourhood*. The **adaptive threshold** is the mean of the block around the pixel, less a constant.

# %%
own_cut = adaptive_threshold(rug, 31, 5)
show([one_cut, own_cut], ["one threshold (Otsu)", "each pixel its own: mean of 31 × 31, less 5"], columns=1,
     caption="With a threshold of its own for every pixel the stripes go on through sun and shade.",
     alt="Above, the rug split in white and black areas; below, its zigzag stripes all over.")

assert (own_cut == cv2.adaptiveThreshold(rug, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY, 31, 5)).all()

# %% [markdown]
# ## 6 · Your turn: Otsu by hand (10 minutes)
#
# Write `otsu(gray)`: a (height, width) uint8 picture in, the threshold out as one whole number: the *smallest* `t` whose between-class variance is the largest. Pixels above `t` are one group, pixels at or below it the other.

# %% role="exercise"
exercise(
    "binarization-otsu",
    title="Otsu's threshold",
    function="otsu",
    time_limit=10,
    refused=("cv2", "skimage", "imgproc_course.imaging"),
    hint="Count with np.bincount; for each t compute shares and means of the two groups; keep the first t that wins.",
)


# %% role="answer"
def otsu(gray):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    levels = np.arange(256)
    best, largest = 0, 0.0
    for t in range(256):
        below, above = int(counts[: t + 1].sum()), int(counts[t + 1 :].sum())
        if below == 0 or above == 0:
            continue
        mean_below = int((levels[: t + 1] * counts[: t + 1]).sum()) / below
        mean_above = int((levels[t + 1 :] * counts[t + 1 :]).sum()) / above
        variance = below * above * (mean_below - mean_above) ** 2
        if variance > largest * (1 + 1e-12):
            best, largest = t, variance
    return best


# %% role="check"
check("binarization-otsu", otsu)


# %% role="case" title="print on paper" points=1 hint="Two hills: the threshold lies where the first one ends."
def inputs(rng):
    dark, bright = rng.integers(20, 60), rng.integers(160, 220)
    picture = np.where(rng.random((16, 20)) < 0.4, dark, bright) + rng.integers(-9, 10, size=(16, 20))
    return (picture.astype(np.uint8),)


# %% role="case" title="little ink, much paper" points=1 hint="The shares of the two groups weigh the difference of their means."
def inputs(rng):
    dark, bright = rng.integers(10, 40), rng.integers(150, 240)
    picture = np.where(rng.random((24, 24)) < 0.06, dark, bright) + rng.integers(-8, 9, size=(24, 24))
    return (picture.astype(np.uint8),)


# %% role="hidden" title="hills that touch" points=1 hint="A pixel equal to t belongs to the lower group."
def inputs(rng):
    picture = np.where(rng.random((40, 40)) < 0.5, 95, 150) + rng.normal(0, 22, size=(40, 40))
    return (np.clip(picture, 0, 255).astype(np.uint8),)


# %% role="hidden" title="two values alone" points=1 hint="Many thresholds part two values equally well: the smallest counts."
def inputs(rng):
    low, high = rng.integers(0, 100), rng.integers(150, 256)
    picture = np.full((6, 6), high, dtype=np.uint8)
    picture[: rng.integers(1, 5)] = low
    return (picture,)


# %% role="mistake" name="the smallest variance instead of the largest" says="You kept the threshold at which the groups differ least. The between-class variance is to be as large as possible."
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    levels = np.arange(256)
    found = {}
    for t in range(256):
        below, above = counts[: t + 1].sum(), counts[t + 1 :].sum()
        if below and above:
            means = (levels[: t + 1] * counts[: t + 1]).sum() / below, (levels[t + 1 :] * counts[t + 1 :]).sum() / above
            found[t] = below * above * (means[0] - means[1]) ** 2
    return min(found, key=found.get)


# %% role="mistake" name="the middle of the range" says="Halfway between the darkest and the brightest pixel ignores how many pixels there are of each. Otsu counts them."
def otsu(gray):
    return (int(gray.min()) + int(gray.max())) // 2


# %% role="mistake" name="the mean gray level" says="The mean follows the larger group. Otsu looks for the cut that parts the two."
def otsu(gray):
    return int(gray.mean())


# %% role="mistake" name="one too high" says="Your threshold is one too high: a pixel equal to t belongs to the lower group, so t is the last gray level of that group."
def otsu(gray):
    return solution(gray) + 1


# %% [markdown]
# ## Recap
#
# A threshold turns gray levels into yes or no. Otsu finds the cut between two hills; where light changes over the picture, each pixel needs a threshold of its own.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *gray* | (720, 1280) | uint8 | 0 to 255 | gray level |
# | histogram | (256,) | int64 | 0 to 921,600 | pixels |
# | between-class variance | (256,) | float64 | 0 to 16,256.25 | gray level squared |
# | threshold | one number | int | 0 to 255 | gray level |
# | binary | (720, 1280) | uint8 | 0 and 255 | no and yes |

# %%
assert counts.shape == (256,) and counts.dtype == np.int64 and gray.size == 921_600
assert (255 / 2) ** 2 == 16_256.25 and variances.max() < 16_256.25
assert threshold(gray, 128).shape == (720, 1280) and threshold(gray, 128).dtype == np.uint8
