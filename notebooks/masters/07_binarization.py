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
# ## 6 · Your turn: Otsu from the pixels (15 minutes)
#
# Section 3 counted the pixels in a histogram. Find the same threshold without a histogram: write `otsu(gray)`, which tries every `t` from 0 to 255 and selects the pixels of the two classes with masks, as for the eight pixels.
#
# - A pixel equal to `t` belongs to class 0.
# - If a class is empty, it has no mean: the between-class variance is 0.
# - If several thresholds have the largest variance, return the *smallest* of them. So the result for an image with only one gray level is 0.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: (height, width) uint8 | the threshold `t`, one whole number (`int`) from 0 to 255 | `otsu(marker)` |
#
# Compute it yourself, with NumPy only. `np` is known in your cell. Import everything else that you use in this cell.

# %% role="exercise"
exercise(
    "binarization-otsu",
    title="Otsu's threshold",
    function="otsu",
    time_limit=10,
    refused=("cv2", "skimage", "imgproc_course.imaging"),
    hint="For each t from 0 to 255 compute the shares and the means of the two classes, gray <= t and gray > t. Keep the first t with the largest between-class variance.",
    hints=(
        "Take the eight pixels of section 3 and t = 25. Which pixels are in class 0? Which two shares and which two means do you need? How would you remember the best t while you try the next one?",
        "1. Begin with best_t = 0 and a best variance of 0. 2. Loop over t in range(256). 3. Select the two classes with masks. 4. If one of them is empty, go on with the next t (continue). 5. Compute the variance from the two sizes and the two means. 6. If it is larger than the best variance, store both t and the variance. 7. Return best_t after the loop.",
        "below, above = gray[gray <= t], gray[gray > t]; variance = (below.size / gray.size) * (above.size / gray.size) * (below.mean() - above.mean()) ** 2; if variance > best_variance: best_t, best_variance = t, variance.",
    ),
    explanation="A mask selects the pixels of a class, so .size and .mean() of the selection give its share and its mean. The comparison is > and not >=, so a later t with the same variance does not replace an earlier one. The start values are also the answer for an image with one gray level: no t splits it, and 0 stays.",
    another_way="You can also count the gray levels once with np.bincount, as section 3 does, and compute the shares and means from the counts: this is much faster for a large image.",
)


def scores(gray, score):
    """{t: score(below, above)} for every t that leaves no class empty."""
    pairs = {t: (gray[gray <= t].astype(float), gray[gray > t].astype(float)) for t in range(256)}
    return {t: score(below, above) for t, (below, above) in pairs.items() if below.size and above.size}


def best_of(gray, score):
    """The first t with the largest score."""
    score_at = scores(gray, score)
    return max(score_at, key=score_at.get, default=0)


def variance_of(below, above):
    count = below.size + above.size
    return below.size / count * above.size / count * (below.mean() - above.mean()) ** 2


def counts_of(gray):
    return np.bincount(gray.ravel(), minlength=256)


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
    dark, bright = rng.integers(20, 60), rng.integers(160, 220)
    image = np.where(rng.random((16, 20)) < 0.4, dark, bright) + rng.integers(-9, 10, size=(16, 20))
    return (image.astype(np.uint8),)


# %% role="case" title="little print, much paper" points=1 hint="Multiply the squared difference of the means by the shares of both classes."
def inputs(rng):
    image = np.where(rng.random((24, 24)) < 0.1, 60, 170) + rng.normal(0, 20, size=(24, 24))
    return (np.clip(image, 0, 255).astype(np.uint8),)


# %% role="case" title="a wide and a narrow peak" points=0
def inputs(rng):
    is_wide = rng.random((24, 24)) < 0.7
    image = np.where(is_wide, rng.normal(90, 32, size=(24, 24)), rng.normal(170, 12, size=(24, 24)))
    return (np.clip(image, 0, 255).astype(np.uint8),)


# %% role="case" title="a few bright and a few dark pixels" points=0 hint="The formula multiplies both shares and the square of the difference of the means: w0 * w1 * (mean0 - mean1) ** 2."
def inputs(rng):
    image = rng.integers(148, 153, size=64).astype(np.uint8)
    image[:5], image[-2:] = 100, 250
    return (rng.permutation(image).reshape(8, 8),)


# %% role="case" title="the first and the last threshold" points=0 hint="Try every t from 0 to 255, and leave no t out."
def inputs(rng):
    corner = rng.integers(1, 4)
    black_and_white = np.full((5, 6), 255, dtype=np.uint8)
    black_and_white[:corner] = 0
    nearly_white = np.full((5, 6), 255, dtype=np.uint8)
    nearly_white[:corner] = 254
    return [(black_and_white,), (nearly_white,)]


# %% role="case" title="one gray level" points=0 hint="No t splits this image into two classes, so every variance is 0, and the smallest t is 0."
def inputs(rng):
    return (np.full((4, 5), rng.integers(50, 200), dtype=np.uint8),)


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


# %% role="mistake" name="the smallest variance instead of the largest" says="Your threshold has the smallest between-class variance, which is the same as the largest variance inside the classes. Look for the largest between-class variance instead."
def otsu(gray):
    return best_of(gray, lambda below, above: -variance_of(below, above))


# %% role="mistake" name="shares left out" says="Your threshold ignores the shares of the two classes. The formula multiplies the squared difference of the means by both shares: w0 * w1 * (mean0 - mean1) ** 2."
def otsu(gray):
    return best_of(gray, lambda below, above: (below.mean() - above.mean()) ** 2)


# %% role="mistake" name="only the share of class 0" says="Only the share of class 0 is used. The formula multiplies by the shares of both classes: w0 * w1 * (mean0 - mean1) ** 2."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * (below.mean() - above.mean()) ** 2)


# %% role="mistake" name="only the share of class 1" says="Only the share of class 1 is used. The formula multiplies by the shares of both classes: w0 * w1 * (mean0 - mean1) ** 2."
def otsu(gray):
    return best_of(gray, lambda below, above: above.size * (below.mean() - above.mean()) ** 2)


# %% role="mistake" name="difference not squared" says="The difference of the means is not squared. Without ** 2 it is negative for every t, because class 0 is the darker one."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * above.size * (below.mean() - above.mean()))


# %% role="mistake" name="the wrong square" says="Only the difference of the means must be squared. You use it without a square (abs), or you square the whole product. The formula is w0 * w1 * (mean0 - mean1) ** 2."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * above.size * abs(below.mean() - above.mean()))


# %% role="mistake" name="means in whole numbers" says="The means are whole numbers: // and int() drop the fraction. Divide with /, or use .mean(), and keep the float."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * above.size * (below.sum() // below.size - above.sum() // above.size) ** 2)


# %% role="mistake" name="medians instead of means" says="The medians of the classes are used. The formula needs their means: .mean()."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * above.size * (np.median(below) - np.median(above)) ** 2)


# %% role="mistake" name="sums in uint8" says="The sums of the gray levels were computed in uint8, which wraps around at 255. Use .mean(), or widen with astype(int) before you add."
def otsu(gray):
    def score(below, above):
        means = [part.sum() % 256 / part.size for part in (below, above)]
        return below.size * above.size * (means[0] - means[1]) ** 2

    return best_of(gray, score)


# %% role="mistake" name="means of the counts" says="The means are means of the counts, not of the gray levels. Each gray level must be multiplied by its count, and the sum divided by the number of pixels; or take the mean of the pixels of each class."
def otsu(gray):
    counts = counts_of(gray)
    best_t, largest = 0, -1.0
    for t in range(255):
        below, above = counts[: t + 1], counts[t + 1 :]
        variance = float(below.sum()) * float(above.sum()) * (below.mean() - above.mean()) ** 2
        if below.sum() and above.sum() and variance > largest:
            best_t, largest = t, variance
    return best_t


# %% role="mistake" name="the sums of the variances" says="You add the variances inside the two classes without their shares. Take the between-class variance with both shares, w0 * w1 * (mean0 - mean1) ** 2, and its largest value."
def otsu(gray):
    return best_of(gray, lambda below, above: -below.var() - above.var())


# %% role="mistake" name="the most frequent gray level" says="This is the most frequent gray level, the highest bar of the histogram. It is not a threshold between two classes: compute the between-class variance of every t, and take the t with the largest."
def otsu(gray):
    return int(np.argmax(counts_of(gray)))


# %% role="mistake" name="the middle of the range" says="This is the middle between the darkest and the brightest pixel. It ignores how many pixels have each gray level. Compute the between-class variance of every t instead."
def otsu(gray):
    return (int(gray.min()) + int(gray.max())) // 2


# %% role="mistake" name="the mean gray level" says="This is the mean gray level, which is not Otsu's threshold. Try every t, and keep the one with the largest between-class variance."
def otsu(gray):
    return int(gray.mean())


# %% role="mistake" name="the median gray level" says="This is the median gray level, which is not Otsu's threshold. Try every t, and keep the one with the largest between-class variance."
def otsu(gray):
    return int(np.median(gray))


# %% role="mistake" name="always 128" says="Your function returned 128 for every image, a fixed number. The threshold must be computed from the gray levels of each image."
def otsu(gray):
    return 128


# %% role="mistake" name="always 127" says="Your function returned 127 for every image, a fixed number. The threshold must be computed from the gray levels of each image."
def otsu(gray):
    return 127


# %% role="mistake" name="always 0" says="Your function returned 0 for every image. If return is inside the for loop, the function ends with the first t: move it to the left, below the loop. If not, see that best_t gets a new value in the loop."
def otsu(gray):
    return 0


# %% role="mistake" name="always 255" says="Your function returned 255 for every image, the last t of the loop. Return the t with the largest between-class variance: store it in the loop."
def otsu(gray):
    return 255


# %% role="mistake" name="one too large" says="Your threshold is one too large: a pixel equal to t belongs to class 0. Split with gray <= t and gray > t. In a histogram the slice counts[:t] ends before t: write counts[: t + 1]."
def otsu(gray):
    return solution(gray) + 1 if gray.min() < gray.max() else 0


# %% role="mistake" name="one too large, always" says="Your threshold is one too large: a pixel equal to t belongs to class 0, so t is the last gray level of class 0."
def otsu(gray):
    return solution(gray) + 1


# %% role="mistake" name="one too small" says="Your threshold is one too small: t is the last gray level of class 0. Split with gray <= t and gray > t."
def otsu(gray):
    return solution(gray) - 1


# %% role="mistake" name="the last of equal thresholds" says="Several thresholds have the same largest variance, and you return the last of them. With >= a later t replaces an earlier one: use >, so that the smallest t stays."
def otsu(gray):
    score_at = scores(gray, variance_of)
    largest = max(score_at.values(), default=0)
    return max((t for t in score_at if score_at[t] == largest), default=0)


# %% role="mistake" name="the last of equal thresholds, also with an empty class" says="Several thresholds have the same largest variance, and you return the last of them. With >= a later t replaces an earlier one: use >, so that the smallest t stays."
def otsu(gray):
    score_at = dict.fromkeys(range(256), 0.0) | scores(gray, variance_of)
    return max(t for t in score_at if score_at[t] == max(score_at.values()))


# %% role="mistake" name="the mean of an empty class" says="A class without pixels has the mean nan, and np.argmax takes nan for the largest value. Leave out every t that leaves a class empty, or give it the variance 0."
def otsu(gray):
    return 0 if gray.min() > 0 else int(gray.max())


# %% role="mistake" name="thresholds left out at both ends" says="The first and the last thresholds are not tried. Try every t from 0 to 255: range(256)."
def otsu(gray):
    score_at = {t: score for t, score in scores(gray, variance_of).items() if 1 <= t < 254}
    return max(score_at, key=score_at.get, default=1)


# %% role="mistake" name="the threshold 0 left out" says="The threshold 0 is not tried. Try every t from 0 to 255: range(256) begins with 0."
def otsu(gray):
    return max(1, solution(gray)) if gray.min() < gray.max() else 0


# %% role="mistake" name="no start value for one gray level" says="If the image has only one gray level, no t splits it, and your variable never gets a value. Give it a start value, 0, before the loop."
def otsu(gray):
    if gray.min() < gray.max():
        best_t = solution(gray)
    return best_t


# %% role="mistake" name="the variance" says="You return the largest variance itself. The task asks for the t that has it."
def otsu(gray):
    return max(scores(gray, variance_of).values(), default=0.0)


# %% role="mistake" name="the variance from the numbers of pixels" says="You return the largest variance itself. The task asks for the t that has it."
def otsu(gray):
    return max((score * gray.size**2 for score in scores(gray, variance_of).values()), default=0.0)


# %% role="mistake" name="the binary image" says="You return the binary image. The task asks for the threshold itself, one number: return t."
def otsu(gray):
    return np.where(gray > solution(gray), 255, 0).astype(np.uint8)


# %% role="mistake" name="the mask" says="You return a mask of the image. The task asks for the threshold itself, one number: return t."
def otsu(gray):
    return gray > solution(gray)


# %% role="mistake" name="t and its variance" says="You return two values, the threshold and its variance. The task asks for the threshold alone."
def otsu(gray):
    t = solution(gray)
    return t, scores(gray, variance_of).get(t, 0.0)


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
