# ---
# jupyter:
#   imgproc_course:
#     title: Binarization
# ---

# %% [markdown]
# # Binarization
#
# Is this pixel print or paper, obstacle or floor? Often a robot needs a yes or a no for each pixel. **Binarization** splits the pixels into the *foreground*, the part you are interested in, and the *background*, everything else. It compares each gray level with a [[term:threshold]]. In this lesson you learn how to choose the threshold.
#
# **You will be able to**
# - make a binary image with a threshold, and choose a threshold from a histogram,
# - compute Otsu's threshold by hand, with the same result as OpenCV,
# - explain when one threshold for the whole image fails, and what works instead.
#
# **Time** [[minutes]]; take a break after section 3. **You need** [[arrays]], [[grayscale]] and [[noise_removal]].

# %% role="given" exercise=["binarization-otsu"]
import numpy as np

# %%
import cv2
from matplotlib.figure import Figure

from imgproc_course.display import show, show_figure
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.imaging import adaptive_threshold, otsu_threshold
from imgproc_course.imaging import threshold, to_gray
from imgproc_course.recording import open_recording

# %% role="texts"
figure_texts = {
    "tiny": (
        "Above means strictly above: 100 is not above 100, so this pixel becomes black.",
        "A five by five grid of gray numbers, and the same grid in black and white with 0 and 255.",
    ),
    "marker": (
        "Black print on white paper, seen by the robot from a distance of 3.6 metres.",
        "A black square with a white pattern of bits on white paper.",
    ),
    "histogram": (
        "Two peaks: the print on the left, the paper on the right. The gray levels between them come from the blurred edges of the print and from the wall. A threshold in this valley works, such as 128.",
        "A histogram with one peak of dark and one of bright gray levels, and a blue line at 128 between them.",
    ),
    "otsu": (
        "The curve is highest at Otsu's threshold, which separates the two peaks best. The red line marks it.",
        "Above, the marker's histogram; below, a curve with one broad maximum; a red line through both.",
    ),
    "binary marker": (
        "The print is black and the paper is white: now a program can read the pattern of the marker.",
        "The marker in gray and in pure black and white.",
    ),
    "rug": (
        "The rug with its dark stripes. The part on the right lies in the shade, the rest in the sun.",
        "A rug with dark zigzag stripes, bright on the left and darker on the right.",
    ),
    "global": (
        "In the shade the stripes are separated. In the sun nearly everything is white, and the stripes are lost.",
        "The rug in black and white: stripes on the right, a white area without stripes on the left.",
    ),
    "adaptive": (
        "With an adaptive threshold the stripes are visible in the sun and in the shade.",
        "Above, zigzag stripes only on the right; below, zigzag stripes everywhere.",
    ),
}

# %%
recording = open_recording("drive")
gray = to_gray(recording.frame(30))
print(gray.shape, gray.dtype, "range", gray.min(), "to", gray.max())

# %% [markdown]
# ## 1 · A global threshold ([[minutes]])
#
# In the image below, every value above 100 becomes 255 (white), and all others become 0 (black). This is a **global threshold**: one number for the whole image.
#
# **Predict** which value the 100 in the middle gets.

# %% role="predict"
guess_middle = None  # your guess: 0 or 255?

# %%
tiny = np.array([[20, 30, 40, 180, 190],
                 [25, 35, 45, 185, 195],
                 [30, 40, 100, 190, 200],
                 [35, 45, 160, 195, 205],
                 [40, 50, 170, 200, 210]], dtype=np.uint8)
binary = np.where(tiny > 100, 255, 0).astype(np.uint8)
show([tiny, binary], ["gray", "above 100"], text="binarization/tiny")
compare_guess(guess_middle, binary[2, 2])

# %% [markdown]
# `threshold(tiny, 100)` of the course gives the same image. OpenCV compares in the same way: strictly above.

# %%
# Check: the numbers in this section
assert binary[2, 2] == 0 and np.unique(binary).tolist() == [0, 255]
assert (threshold(tiny, 100) == binary).all()
assert (cv2.threshold(tiny, 100, 255, cv2.THRESH_BINARY)[1] == binary).all()

# %% [markdown]
# ## 2 · The histogram ([[minutes]])
#
# The marker in front of the back wall is black print, the foreground, on white paper.

# %%
marker = gray[319:395, 656:724]
show(marker, "the marker", text="binarization/marker")

# %% [markdown]
# A **histogram** counts how many pixels have each gray level. `np.bincount` counts how often each whole number occurs in a list: first how many 0, then how many 1, and so on. `ravel` makes such a list of an image: all rows, one after another.

# %%
levels = np.array([[2, 0, 2], [5, 2, 0]])
print("as one list:", levels.ravel())
print("counts:     ", np.bincount(levels.ravel()))

# %% [markdown]
# There are two zeros, no 1, three times 2, no 3, no 4, and one 5. Now the marker.
#
# **Predict** how many percent of its pixels are bright: above 128.

# %% role="predict"
guess_share = None  # your guess: how many percent?

# %%
counts = np.bincount(marker.ravel(), minlength=256)
print("pixels with the gray level 100:", counts[100])
bright_share = counts[129:].sum() / marker.size
compare_guess(guess_share, round(bright_share * 100), "%")

# %% [markdown]
# (`minlength=256` gives one count for every gray level up to 255.) The library *Matplotlib* draws the histogram: a `Figure` is the sheet, `add_subplot` adds a diagram, `bar` draws a bar for each count, and `set` writes the labels.

# %%
figure = Figure(figsize=(8, 2.6), dpi=100, layout="constrained")
axes = figure.add_subplot()
axes.bar(range(256), counts, width=1, color="0.35")
axes.axvline(128, color="tab:blue")  # a vertical line
axes.set(xlabel="gray level", ylabel="pixels", xlim=(0, 255))
show_figure(figure, text="binarization/histogram")

# %%
# Check: the numbers in this section
assert np.bincount(levels.ravel()).tolist() == [2, 0, 3, 0, 0, 1]
assert counts.sum() == marker.size == 76 * 68 and counts.shape == (256,)
assert round((marker > 128).mean(), 9) == round(bright_share, 9)
depth = recording.depth(30)[160:198, 328:362]  # millimetres, at half the size
assert round(np.median(depth) / 1000, 1) == 3.6

# %% [markdown]
# ## 3 · Otsu's method ([[minutes]])
#
# A histogram with two peaks is *bimodal*. You see the valley between them; a program needs a rule. **Otsu's method** (1979) tries every threshold, which splits the pixels into two classes. It keeps the one with the largest **between-class variance**, a measure of how much they differ:
#
# $$\sigma_B^2(t) = w_0\, w_1\, (\mu_0 - \mu_1)^2$$
#
# - Class 0 has the pixels at or below the threshold $t$, class 1 those above.
# - $w_0$ and $w_1$, the weights, are the shares of all pixels in the classes.
# - $\mu_0$ and $\mu_1$ (Greek mu) are their mean gray levels; $\sigma_B^2$ (sigma squared) is the variance.
#
# By hand for eight pixels, 10, 20, 20, 30, 180, 190, 200, 210, and $t = 195$: six are in class 0, with the mean 75, and two in class 1, with the mean 205. So
#
# $$\sigma_B^2(195) = \tfrac{6}{8} \cdot \tfrac{2}{8} \cdot (75 - 205)^2$$
#
# $$= 0.75 \cdot 0.25 \cdot 16900 = 3168.75$$
#
# Why multiply by the shares? Their product is largest for two halves, so a few extreme pixels do not easily become a class.
#
# **Predict** which threshold is the best for the eight pixels: 15, 25, 100 or 195.

# %% role="predict"
guess_t = None  # your guess: 15, 25, 100 or 195?

# %%
eight = np.array([10, 20, 20, 30, 180, 190, 200, 210])
thresholds = [15, 25, 100, 195]
variances = []
for t in thresholds:
    below, above = eight[eight <= t], eight[eight > t]
    w0, w1 = below.size / 8, above.size / 8
    variances.append(w0 * w1 * (below.mean() - above.mean()) ** 2)
    print(f"t = {t:3}  shares {w0} and {w1}  variance {variances[-1]:.2f}")
best_position = np.argmax(variances)  # where the largest variance is
compare_guess(guess_t, thresholds[best_position])

# %% [markdown]
# The best of the four is 100, between the dark values (up to 30) and the bright values (from 180).
#
# For the marker we try all thresholds. An image has many pixels but only 256 gray levels, so it is faster to compute the means from the histogram: the sum of all gray levels is the sum of each level times its count.

# %%
def between_class_variance(counts, t):
    sums = np.arange(256) * counts  # level times count
    n0, n1 = counts[: t + 1].sum(), counts[t + 1 :].sum()
    mean0 = sums[: t + 1].sum() / n0
    mean1 = sums[t + 1 :].sum() / n1
    w0, w1 = n0 / counts.sum(), n1 / counts.sum()
    return w0 * w1 * (mean0 - mean1) ** 2

# %% [markdown]
# **Predict** Otsu's threshold for the marker. Look at the histogram in section 2.

# %% role="predict"
guess_otsu = None  # your guess: which gray level?

# %%
variances = np.zeros(256)
# From the darkest pixel on, class 0 has pixels; below the brightest, class 1.
for t in range(marker.min(), marker.max()):
    variances[t] = between_class_variance(counts, t)
best = int(np.argmax(variances))
opencv_best, _ = cv2.threshold(marker, 0, 255, cv2.THRESH_OTSU)
print("OpenCV's threshold:", int(opencv_best))
compare_guess(guess_otsu, best)

# %% [markdown]
# Two diagrams show why: the histogram, and the between-class variance of each threshold. (`subplots(2, sharex=True)` makes two diagrams with the same x-axis, and `plot` draws a line.)

# %%
figure = Figure(figsize=(8, 3.6), dpi=100, layout="constrained")
upper, lower = figure.subplots(2, sharex=True)
upper.bar(range(256), counts, width=1, color="0.35")
lower.plot(variances, color="tab:orange")
upper.axvline(best, color="tab:red")
lower.axvline(best, color="tab:red")
upper.set(ylabel="pixels", title=f"Otsu's threshold is {best}")
lower.set(xlabel="threshold t (gray level)", xlim=(0, 255),
          ylabel="between-class\nvariance (level²)")
show_figure(figure, text="binarization/otsu")

# %%
show([marker, threshold(marker, best)], ["gray", f"above {best}"],
     columns=1, text="binarization/binary marker")

# %%
# Check: the numbers in this section
assert eight[:6].mean() == 75 and eight[6:].mean() == 205
assert 6 / 8 * 2 / 8 * (75 - 205) ** 2 == 3168.75
assert thresholds[best_position] == 100 and eight[3] == 30 and eight[4] == 180
assert 4 / 8 * 4 / 8 * (eight[:4].mean() - eight[4:].mean()) ** 2 == 7656.25
assert best == otsu_threshold(marker) == int(opencv_best)

# %% [markdown]
# ## 4 · Planned failure: the sun on the floor ([[minutes]])
#
# *This is a good place for a break.*
#
# A part of a rug with dark stripes lies in the sun. The dark stripes are our foreground.

# %%
rug = gray[415:515, 60:560]
show(rug, "rug, partly in the sun", text="binarization/rug")

# %% [markdown]
# **Predict** how many percent of the sunny pixels become white with Otsu's global threshold. (If the stripes were separated correctly, it would be about 60 %.)

# %% role="predict"
guess_white = None  # your guess: how many percent?

# %%
t = otsu_threshold(rug)
global_result = threshold(rug, t)
show(global_result, f"above {t}", text="binarization/global")
sunny_result = global_result[50:90, 150:250]
compare_guess(guess_white, round((sunny_result == 255).mean() * 100), "%")

# %% [markdown]
# Why does it fail? We compare the dark stripes in the sun with the bright stripes in the shade. `np.percentile(sunny, 10)` is the value below which 10 % of the sunny pixels lie.

# %%
sunny, shady = rug[50:90, 150:250], rug[50:90, 430:500]
dark_in_sun = np.percentile(sunny, 10)
bright_in_shade = np.percentile(shady, 90)
print(f"dark in the sun: {dark_in_sun:.0f}")
print(f"bright in the shade: {bright_in_shade:.0f}")

# %% [markdown]
# The dark stripes in the sun are brighter than the bright stripes in the shade. So no single threshold separates dark from bright stripes. **Repair it**: compare each pixel with *its own neighbourhood*. The **adaptive threshold** of a pixel is the mean of a square block around this pixel, minus a constant. First one row by hand, with blocks of three pixels:

# %%
row = np.array([200, 180, 200, 180, 200, 80, 60, 80, 60, 80])
padded = np.pad(row, 1, mode="edge")
block_means = (padded[:-2] + padded[1:-1] + padded[2:]) / 3
print("row      ", row)
print("threshold", (block_means - 5).round().astype(int))
print("white    ", (row > block_means - 5).astype(int))

# %% [markdown]
# The threshold follows the light: about 185 in the sun, about 65 in the shade. Every stripe is separated correctly, except for one pixel at the border of the shadow: the first 80 has a bright neighbour in its block.
#
# The constant helps in flat areas: there each pixel is nearly equal to its mean, and noise would decide. With "mean minus 5" a flat area is white. Now the rug, with blocks of 31 × 31 pixels:

# %%
adaptive_result = adaptive_threshold(rug, 31, 5)
show([global_result, adaptive_result],
     ["global threshold (Otsu)", "adaptive: mean of 31 × 31, minus 5"],
     columns=1, text="binarization/adaptive")

# %%
# Check: the numbers in this section
method = cv2.ADAPTIVE_THRESH_MEAN_C
opencv_result = cv2.adaptiveThreshold(rug, 255, method, cv2.THRESH_BINARY, 31, 5)
assert (adaptive_result == opencv_result).all()
assert round(dark_in_sun) == 188 and round(bright_in_shade) == 185
assert (sunny_result == 255).mean() > 0.9
assert abs((adaptive_result[50:90, 150:250] == 255).mean() - 0.6) < 0.05
assert (row > block_means - 5).tolist() == [1, 0, 1, 0, 1, 0, 0, 1, 0, 1]
assert np.abs((block_means - 5)[1:4] - 185).max() < 5
assert np.abs((block_means - 5)[6:9] - 65).max() < 5

# %% [markdown]
# ### Your turn: the histogram of the rug ([[minutes]], deeper)
#
# Draw why one threshold cannot work: the histogram of `rug`, as in section 2, with Otsu's threshold `t` as a vertical line. The last figure of the cell is your answer. Save the notebook (Ctrl+S) before you run the check.

# %% role="exercise"
exercise(
    "binarization-plot",
    subject="written",
    title="The histogram of the rug",
    allowed=("cv2", "imgproc_course.imaging", "imgproc_course.recording"),
    points=3,
    rubric=(
        ("the bars are the counts of the 256 gray levels of the rug", 1),
        ("a vertical line at Otsu's threshold of the rug", 1),
        ("both axes are labelled: gray level, and number of pixels", 1),
        ("the histogram is of the whole frame", -1),
    ),
)

# %% role="answer"
figure = Figure(figsize=(8, 2.6), dpi=100, layout="constrained")
axes = figure.add_subplot()
# your turn: draw bars and a line into axes, and label both axes
show_figure(figure, caption="The histogram of the rug.", alt="A histogram.")

# %% role="solution"
figure = Figure(figsize=(8, 2.6), dpi=100, layout="constrained")
axes = figure.add_subplot()
axes.bar(range(256), np.bincount(rug.ravel(), minlength=256), width=1)
axes.axvline(t, color="tab:orange")
axes.set(xlabel="gray level", ylabel="pixels", xlim=(0, 255))
show_figure(figure, caption="The histogram of the rug.", alt="A histogram.")

# %% role="check"
check("binarization-plot")

# %% [markdown]
# ## 5 · Your turn: Otsu from the pixels ([[minutes]])
#
# Find the same threshold without a histogram: write `otsu(gray)`, which tries every `t` from 0 to 255 and selects the pixels of the two classes with [[term:mask|masks]], as for the eight pixels.
#
# - A pixel equal to `t` belongs to class 0.
# - If a class is empty, it has no mean: the between-class variance is 0.
# - If several thresholds have the largest variance, return the *smallest* of them. So the result for an image with only one gray level is 0.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: (height, width) uint8 | the threshold `t`, one whole number (`int`) from 0 to 255 | `otsu(marker)` |
#
# Use NumPy only. `np` is known in your cell. Import everything else that you use in this cell.

# %% role="exercise"
exercise(
    "binarization-otsu",
    title="Otsu's threshold",
    function="otsu",
    time_limit=10,
    allowed=("scipy",),
    hint="For each t from 0 to 255 compute the shares and the means of the two classes, gray <= t and gray > t. Keep the first t with the largest between-class variance. After the loop, return this t, and not its variance.",
    hints=(
        "Take the eight pixels of section 3 and t = 25. Which pixels are in class 0? Which two shares and which two means do you need? How would you remember the best t while you try the next one?",
        "1. Begin with best_t = 0 and best_variance = 0.\n2. Loop over t in range(256).\n3. Select the two classes with masks.\n4. If one of them is empty, go on with the next t (continue).\n5. Compute the variance from the two sizes and the two means.\n6. If it is larger than the best variance, store both t and the variance.\n7. Return best_t after the loop.",
        "Inside the loop, for t in range(256):\n    below, above = gray[gray <= t], gray[gray > t]\n    Here: continue if one of them has the size 0.\n    w0, w1 = below.size / gray.size, above.size / gray.size\n    variance = ?\n    if variance > best_variance:\n        best_t, best_variance = t, variance",
    ),
    explanation="A mask selects the pixels of a class, so .size and .mean() of the selection give its share and its mean. The comparison is > and not >=, so a later t with the same variance does not replace an earlier one. The start values are also the answer for an image with one gray level: no t splits it, and 0 stays.",
    another_way="You can also count the gray levels once with np.bincount, as section 3 does, and compute the shares and means from the counts: this is much faster for a large image.",
)


def print_on_paper(rng):
    dark, bright = rng.integers(20, 60), rng.integers(160, 220)
    image = np.where(rng.random((16, 20)) < 0.4, dark, bright) + rng.integers(-9, 10, size=(16, 20))
    return image.astype(np.uint8)


def black_and_white(rng):
    image = np.full((5, 6), 255, dtype=np.uint8)
    image[: rng.integers(1, 4)] = 0
    return image


def twelve_pixels(rng):
    """Whole-number means, and sums in uint8, give a wrong threshold here, for each offset."""
    offset = rng.integers(0, 41)
    levels = np.array([10, 31, 43, 78, 87, 88, 89, 89, 112, 120, 142, 185]) + offset
    return rng.permutation(levels.astype(np.uint8)).reshape(3, 4)


def two_gray_levels(rng):
    low, high = rng.integers(0, 100), rng.integers(150, 256)
    image = np.full((6, 6), high, dtype=np.uint8)
    image[: rng.integers(1, 5)] = low
    return image


def one_gray_level(rng):
    return np.full((4, 5), rng.integers(50, 200), dtype=np.uint8)

# %% role="answer"
def otsu(gray):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below.size == 0 or above.size == 0:
            continue
        shares = (below.size / gray.size) * (above.size / gray.size)
        variance = shares * (below.mean() - above.mean()) ** 2
        if variance > best_variance:
            best_t, best_variance = t, variance
    return best_t


# %% role="check"
check("binarization-otsu", otsu)

# %% role="case" title="print on paper" points=1
def inputs(rng):
    return [(print_on_paper(rng),), (print_on_paper(rng),)]


# %% role="case" title="little print, much paper" points=1 hint="Multiply the squared difference of the means by the shares of both classes."
def inputs(rng):
    image = np.where(rng.random((24, 24)) < 0.1, 60, 170) + rng.normal(0, 20, size=(24, 24))
    return [(np.clip(image, 0, 255).astype(np.uint8),), (print_on_paper(rng),)]


# %% role="case" title="a wide and a narrow peak" points=0
def inputs(rng):
    is_wide = rng.random((24, 24)) < 0.7
    image = np.where(is_wide, rng.normal(90, 32, size=(24, 24)), rng.normal(170, 12, size=(24, 24)))
    image[0, 0] = 0
    return (np.clip(image, 0, 255).astype(np.uint8),)

# %% role="case" title="a few bright and a few dark pixels" points=0 hint="The formula multiplies both shares and the square of the difference of the means: w0 * w1 * (mean0 - mean1) ** 2."
def inputs(rng):
    image = rng.integers(148, 153, size=64).astype(np.uint8)
    image[:5], image[-2:] = 100, 250
    return (rng.permutation(image).reshape(8, 8),)

# %% role="case" title="the first and the last threshold" points=0 hint="Try every t from 0 to 255, and leave no t out."
def inputs(rng):
    image = black_and_white(rng)
    return [(image,), (np.where(image == 0, 254, image).astype(np.uint8),)]


# %% role="case" title="one gray level" points=0 hint="No t splits this image into two classes, so every variance is 0, and the smallest t is 0."
def inputs(rng):
    return (one_gray_level(rng),)

# %% role="hidden" title="peaks that touch, and twelve pixels" points=1 hint="A pixel equal to t belongs to class 0. Keep the means as floats."
def inputs(rng):
    image = np.where(rng.random((40, 40)) < 0.5, 95, 150) + rng.normal(0, 22, size=(40, 40))
    return [(np.clip(image, 0, 255).astype(np.uint8),), (twelve_pixels(rng),)]


# %% role="hidden" title="one or two gray levels" points=1 hint="Try every t from 0 to 255. Many thresholds separate two values equally well: return the smallest. With one gray level the result is 0."
def inputs(rng):
    return [(image(rng),) for image in (two_gray_levels, black_and_white, one_gray_level, two_gray_levels)]


# %% [markdown]
# ## Recap
#
# A threshold separates foreground and background. Otsu's method finds the global threshold between the two peaks of the histogram. If the light changes over the image, use an adaptive threshold.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *gray* | (720, 1280) | uint8 | 0 to 255 | gray level |
# | histogram | (256,) | int64 | 0 to 921,600 | pixels |
# | between-class variance | (256,) | float64 | 0 to 16,256.25 | gray level squared |
# | threshold | one number | int | 0 to 255 | gray level |
# | binary | (720, 1280) | uint8 | 0 and 255 | no and yes |
#
# **Next:** [[canny_stages]].

# %%
# Check: the numbers in the table
binary = threshold(gray, 128)
assert counts.shape == (256,) and counts.dtype == np.int64 and gray.size == 921_600
assert (255 / 2) ** 2 == 16_256.25 and variances.max() < 16_256.25
assert binary.shape == (720, 1280) and binary.dtype == np.uint8
