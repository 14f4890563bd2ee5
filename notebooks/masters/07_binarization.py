# ---
# jupyter:
#   imgproc_course:
#     title: Binarization
#     minutes: 45
# ---

# %% [markdown]
# # Binarization
#
# Is this pixel print or paper? Is it marker or wall, obstacle or floor? Often a robot needs a yes or a no for each pixel. **Binarization** splits the pixels into the *foreground*, the part you are interested in, and the *background*, everything else. It compares each gray level with a *threshold*. In this lesson you learn how to choose the threshold.
#
# **You will be able to**
# - make a binary image with a threshold, and choose a threshold from a histogram,
# - compute Otsu's threshold by hand, with the same result as OpenCV,
# - explain when one threshold for the whole image fails, and what works instead.
#
# **Time** about 45 minutes. **You need** [[grayscale]] and [[noise_removal]].

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
# ## 1 · A global threshold (5 minutes)
#
# **Ask.** In the image below, every value above 100 becomes 255 (white), and all others become 0 (black). This is a **global threshold**: one number for the whole image. **Predict** what happens to the 100 in the middle.

# %%
tiny = np.array([[20, 30, 40, 180, 190],
                 [25, 35, 45, 185, 195],
                 [30, 40, 100, 190, 200],
                 [35, 45, 160, 195, 205],
                 [40, 50, 170, 200, 210]], dtype=np.uint8)
binary = np.where(tiny > 100, 255, 0).astype(np.uint8)
show([tiny, binary], ["gray", "above 100"], encoding="mono8",
     caption="Above means strictly above: 100 is not above 100, so this pixel becomes black.",
     alt="A five by five grid of gray numbers, and the same grid in black and white with 0 and 255.")

assert binary[2, 2] == 0 and np.unique(binary).tolist() == [0, 255]
assert (threshold(tiny, 100) == binary).all()

# %% [markdown]
# ## 2 · The histogram (7 minutes)
#
# The marker in front of the back wall is black print on white paper. The print is the foreground, the paper is the background. A **histogram** counts how many pixels have each gray level. **Predict** its shape: does it have one *peak* (a hill) or two?

# %%
marker = gray[319:395, 656:724]
counts = np.bincount(marker.ravel(), minlength=256)  # counts[100] is the number of pixels with gray level 100
show(marker, "the marker", encoding="mono8",
     caption="Black print on white paper, seen by the robot from a distance of 3.6 metres.",
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


show_figure(draw_histogram(counts, {"threshold in the middle": (128, "tab:blue")}, "pixels of each gray level"),
            caption="Two peaks: the print on the left, the paper on the right. Any threshold in the valley between them works.",
            alt="A histogram with one peak of dark and one of bright gray levels, and a blue line at 128 between them.")

# %% [markdown]
# ## 3 · Otsu's method (10 minutes)
#
# A histogram with two peaks is called *bimodal*. A person sees the valley between the peaks, but a program needs a rule. **Otsu's method** (1979) tries every threshold. Each threshold splits the pixels into two classes. The method keeps the threshold with the largest **between-class variance**, which measures how much the two classes differ:
#
# $$\sigma_B^2(t) = w_0\, w_1\, (\mu_0 - \mu_1)^2$$
#
# Class 0 contains the pixels at or below the threshold $t$, class 1 the pixels above $t$. The weights $w_0$ and $w_1$ say which share of all pixels is in each class. $\mu_0$ and $\mu_1$ (the Greek letter mu) are the mean gray levels of the two classes, and $\sigma_B^2$ (sigma squared) is the between-class variance.
#
# The next cell computes it for eight pixels and four thresholds. **Predict** which of the four thresholds is the best.

# %%
eight = np.array([10, 20, 20, 30, 180, 190, 200, 210])
variance_at = {}  # threshold: variance
for t in (15, 25, 100, 195):
    below, above = eight[eight <= t], eight[eight > t]
    variance_at[t] = below.size / 8 * above.size / 8 * (below.mean() - above.mean()) ** 2
    print(f"t = {t:3}   {below.size} in class 0, {above.size} in class 1   between-class variance {variance_at[t]:8.1f}")

assert 4 / 8 * 4 / 8 * (eight[:4].mean() - eight[4:].mean()) ** 2 == 7656.25 == variance_at[100]
assert max(variance_at, key=variance_at.get) == 100 and eight[3] == 30 and eight[4] == 180

# %% [markdown]
# The best of the four is 100. It lies between the dark values (up to 30) and the bright values (from 180), and has the largest between-class variance. Now we try all 256 thresholds on the marker.

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
best = int(np.argmax(variances))  # the position of the largest value
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
show_figure(figure, caption="The curve is highest at Otsu's threshold, which separates the two peaks best. The red line marks it.",
            alt="Above, the marker's histogram; below, a curve with one broad maximum; a red line through both.")

# %%
show([marker, threshold(marker, best)], ["gray", f"above {best}"], encoding="mono8",
     caption="The print is black and the paper is white: now a program can read the pattern of the marker.",
     alt="The marker in gray and in pure black and white.")

# %% [markdown]
# ## 4 · Two more examples (5 minutes)
#
# Otsu's method on the sign on the wall, and on a photograph of a man with a camera, one of scikit-image's example images (CC0, free to use).

# %%
from skimage import data

sign = to_gray(recording.frame(75))[215:310, 660:800]
photograph = data.camera()
for name, image in {"sign": sign, "photograph": photograph}.items():
    print(f"{name:10} Otsu's threshold {otsu_threshold(image)}")

show([photograph, threshold(photograph, otsu_threshold(photograph))], ["photograph", "Otsu"],
     caption="The dark coat is separated from the bright sky and grass: a global threshold is enough here.",
     alt="A man behind a camera on a tripod, in gray and in black and white.")
assert otsu_threshold(photograph) == int(cv2.threshold(photograph, 0, 255, cv2.THRESH_OTSU)[0])

# %% [markdown]
# ## 5 · Planned failure: the sun on the floor (8 minutes)
#
# Half of a rug with dark stripes lies in the sun. The dark stripes are our foreground. **Predict** what a global threshold does to the half in the sun.

# %%
rug = gray[415:515, 60:560]
global_result = threshold(rug, otsu_threshold(rug))
show([rug, global_result], ["rug, partly in the sun", f"above {otsu_threshold(rug)}"], encoding="mono8", columns=1,
     caption="A global threshold separates sun and shade instead of dark and bright stripes.",
     alt="A striped rug with a bright sunny part; below, the sunny part is all white.")

# %% [markdown]
# Why does it fail? Compare a dark stripe in the sun with a bright stripe in the shade:

# %%
sunny, shady = rug[50:90, 150:250], rug[50:90, 430:500]
# np.percentile(sunny, 10): 10 % of the sunny pixels are darker than this value
dark_in_sun, bright_in_shade = np.percentile(sunny, 10), np.percentile(shady, 90)
print(f"dark stripes in the sun: {dark_in_sun:.0f}   bright stripes in the shade: {bright_in_shade:.0f}")

assert round(dark_in_sun) == 188 and round(bright_in_shade) == 185

# %% [markdown]
# A dark stripe in the sun is brighter than a bright stripe in the shade. So no single threshold separates dark from bright stripes. **Repair it**: compare each pixel with *its own neighbourhood*. The **adaptive threshold** of a pixel is the mean of a square block around this pixel, minus a constant.

# %%
adaptive_result = adaptive_threshold(rug, 31, 5)
show([global_result, adaptive_result], ["global threshold (Otsu)", "adaptive threshold: mean of 31 × 31, minus 5"], columns=1,
     caption="With an adaptive threshold the stripes are visible in the sun and in the shade.",
     alt="Above, the rug split into a white and a dark area; below, its zigzag stripes everywhere.")

assert (adaptive_result == cv2.adaptiveThreshold(rug, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY, 31, 5)).all()

# %% [markdown]
# ## 6 · Your turn: Otsu by hand (10 minutes)
#
# Write `otsu(gray)`: find the threshold `t` with the largest between-class variance. If several thresholds have it, return the *smallest* of them. A pixel equal to `t` belongs to class 0. Use only NumPy.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: (height, width) uint8 | the threshold `t`, one whole number from 0 to 255 | `otsu(marker)` |

# %% role="exercise"
exercise(
    "binarization-otsu",
    title="Otsu's threshold",
    function="otsu",
    time_limit=10,
    refused=("cv2", "skimage", "imgproc_course.imaging"),
    hint="Count the gray levels with np.bincount. For each t compute the shares and the means of the two classes. Keep the first t with the largest between-class variance.",
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


# %% role="case" title="print on paper" points=1 hint="The histogram has two peaks: the smallest of the best thresholds lies where the first peak ends."
def inputs(rng):
    dark, bright = rng.integers(20, 60), rng.integers(160, 220)
    image = np.where(rng.random((16, 20)) < 0.4, dark, bright) + rng.integers(-9, 10, size=(16, 20))
    return (image.astype(np.uint8),)


# %% role="case" title="little print, much paper" points=1 hint="Multiply the squared difference of the means by the shares of both classes."
def inputs(rng):
    dark, bright = rng.integers(10, 40), rng.integers(150, 240)
    image = np.where(rng.random((24, 24)) < 0.06, dark, bright) + rng.integers(-8, 9, size=(24, 24))
    return (image.astype(np.uint8),)


# %% role="hidden" title="peaks that touch" points=1 hint="A pixel equal to t belongs to class 0."
def inputs(rng):
    image = np.where(rng.random((40, 40)) < 0.5, 95, 150) + rng.normal(0, 22, size=(40, 40))
    return (np.clip(image, 0, 255).astype(np.uint8),)


# %% role="hidden" title="only two values" points=1 hint="Many thresholds separate two values equally well: return the smallest."
def inputs(rng):
    low, high = rng.integers(0, 100), rng.integers(150, 256)
    image = np.full((6, 6), high, dtype=np.uint8)
    image[: rng.integers(1, 5)] = low
    return (image,)


# %% role="mistake" name="the smallest variance instead of the largest" says="You kept the threshold at which the classes differ least. The between-class variance must be as large as possible."
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    levels = np.arange(256)
    variances = {}
    for t in range(256):
        below, above = counts[: t + 1].sum(), counts[t + 1 :].sum()
        if below and above:
            means = (levels[: t + 1] * counts[: t + 1]).sum() / below, (levels[t + 1 :] * counts[t + 1 :]).sum() / above
            variances[t] = below * above * (means[0] - means[1]) ** 2
    return min(variances, key=variances.get)


# %% role="mistake" name="the middle of the range" says="This is the middle between the darkest and the brightest pixel. It ignores how many pixels have each gray level. Otsu's method counts them."
def otsu(gray):
    return (int(gray.min()) + int(gray.max())) // 2


# %% role="mistake" name="the mean gray level" says="This is the mean gray level. It is close to the mean of the larger class. Otsu's method looks for the threshold that separates the two classes best."
def otsu(gray):
    return int(gray.mean())


# %% role="mistake" name="one too high" says="Your threshold is one too high. A pixel equal to t belongs to class 0, so t is the last gray level of class 0."
def otsu(gray):
    return solution(gray) + 1


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

# %%
assert counts.shape == (256,) and counts.dtype == np.int64 and gray.size == 921_600
assert (255 / 2) ** 2 == 16_256.25 and variances.max() < 16_256.25
assert threshold(gray, 128).shape == (720, 1280) and threshold(gray, 128).dtype == np.uint8
