# ---
# jupyter:
#   imgproc_course:
#     title: Noise removal
#     minutes: 60
# ---

# %% [markdown]
# # 05 · Noise removal
#
# Every sensor adds *noise*: small or large errors in the gray levels. To remove them, we compare each pixel with its neighbours. A *filter* computes each new pixel from a neighbourhood of the old one. Which filter helps depends on the noise.
#
# **You will be able to**
# - distinguish Gaussian noise and impulse noise by their numbers,
# - explain kernel, correlation, convolution and border handling,
# - explain why a mean blurs edges and why a median does not,
# - compute a 3 × 3 median by hand,
# - measure with PSNR which of two filters removes more noise, and choose a filter by it.
#
# **Time** about 60 minutes. **You need** lesson 03.

# %% role="given" exercise=["noise-median", "noise-psnr", "noise-choose"]
import numpy as np

# %% tags=["long"]
from imgproc_course.display import show
from imgproc_course.exercises import check
from imgproc_course.imaging import (
    add_gaussian_noise,
    add_salt_and_pepper,
    bilateral_filter,
    box_blur,
    gaussian_blur,
    median_blur,
    psnr,
    ssim,
    to_gray,
)
from imgproc_course.recording import open_recording

recording = open_recording("drive")
gray = to_gray(recording.frame(30))
print("gray", gray.shape, gray.dtype, "range", gray.min(), "to", gray.max())

# %% [markdown]
# ## 1 · Noise is in every image (5 minutes)
#
# **Ask.** A wall has one colour. Does the camera see one gray level? Here are 8 × 8 pixels of the wall. **Predict**: are they all equal, or how much do they differ?

# %%
wall = gray[120:128, 880:888]
show(wall, "a piece of the wall", encoding="mono8",
     caption="The wall has one colour, but the numbers differ: this is the noise of the sensor.",
     alt="An eight by eight grid of nearly equal gray squares with their numbers.")
print("smallest", wall.min(), "  largest", wall.max(), "  standard deviation", round(float(wall.std()), 1), "gray levels")

assert 0 < wall.std() < 5

# %% [markdown]
# ## 2 · One row, one step (10 minutes)
#
# An image consists of many rows, and one row is easier to read. Here is a row with a dark part, a bright part and an *intensity step* between them (intensity is another word for gray level). We add an error of a few gray levels to each value.

# %%
clean_row = np.array([50] * 6 + [200] * 6)
errors = np.array([4, -6, 3, -2, 7, -5, 2, -7, 5, -3, 6, -4])
noisy_row = clean_row + errors
print("clean", clean_row)
print("noisy", noisy_row)

# %% [markdown]
# **Try.** Replace each value by the mean of itself and its two neighbours. The noise gets smaller. **Predict** what happens at the step.

# %%
def mean_of_three(row):
    padded = np.pad(row, 1, mode="edge")
    return (padded[:-2] + padded[1:-1] + padded[2:]) // 3


averaged = mean_of_three(noisy_row)
print("noisy", noisy_row)
print("mean ", averaged)

assert np.abs(averaged[:5] - 50).max() < np.abs(noisy_row[:5] - 50).max()
assert averaged[5] == 101 and averaged[6] == 146

# %% [markdown]
# The flat parts are smoother, but we lost our edge. Between 50 and 200 there are now 101 and 146, values that no pixel of the scene has.
#
# This mean is a **correlation** with a **kernel**: the list of weights 1/3, 1/3, 1/3. (This *filter kernel* is unrelated to the notebook's kernel, which runs your cells.) The kernel moves along the row. At each pixel its weights are multiplied with the values under them, and the products are added. The sum is the **filter response** at this pixel.
#
# A **convolution** does the same, but flips the kernel first. With a symmetric kernel both give the same response; with any other kernel they differ. A row with a single 1, an *impulse*, shows the difference: the convolution gives the kernel as it is, the correlation gives it flipped.

# %%
impulse = np.array([0, 0, 0, 1, 0, 0, 0])
kernel = [1, 2, 3]
print("convolution", np.convolve(impulse, kernel, mode="same"))
print("correlation", np.correlate(impulse, kernel, mode="same"))

assert np.convolve(impulse, kernel, mode="same").tolist() == [0, 0, 1, 2, 3, 0, 0]
assert np.correlate(impulse, kernel, mode="same").tolist() == [0, 0, 3, 2, 1, 0, 0]
assert (np.correlate(impulse, kernel[::-1], mode="same") == np.convolve(impulse, kernel, mode="same")).all()

# %% [markdown]
# OpenCV's filters correlate. Most textbooks write convolution. For the symmetric kernels of this lesson the two are the same; in lesson 07 the difference will be a sign.
#
# ## 3 · Planned failure: a mean against salt and pepper (6 minutes)
#
# A broken pixel is not wrong by a few gray levels: it is black or white. This is **impulse noise**, also called *salt-and-pepper* noise. **Predict** the mean of three around a single white pixel; all other pixels are 50.

# %%
salted_row = np.array([50, 50, 50, 50, 255, 50, 50, 50, 50])
print("salted", salted_row)
print("mean  ", mean_of_three(salted_row))

assert mean_of_three(salted_row).tolist() == [50, 50, 50, 118, 118, 118, 50, 50, 50]

# %% [markdown]
# One wrong pixel became three wrong pixels. **Repair it**: do not average. Sort the three values and take the middle one: the **median**. A single outlier is never in the middle.

# %%
def median_of_three(row):
    padded = np.pad(row, 1, mode="edge")
    return np.sort([padded[:-2], padded[1:-1], padded[2:]], axis=0)[1]


print("salted", salted_row)
print("median", median_of_three(salted_row))
print("step  ", median_of_three(clean_row))

assert (median_of_three(salted_row) == 50).all()
assert (median_of_three(clean_row) == clean_row).all()  # the step is still a step

# %% [markdown]
# ## 4 · Five by five (8 minutes)
#
# In an image a pixel has neighbours on all sides: a neighbourhood of 3 × 3 = 9 values. Their median is the fifth value when they are sorted. **Predict** the median around the white pixel in the middle.

# %%
tiny = np.array([[50, 52, 51, 200, 201],
                 [49, 50, 53, 198, 0],
                 [51, 50, 255, 202, 200],
                 [50, 52, 50, 199, 201],
                 [48, 50, 51, 200, 202]], dtype=np.uint8)
neighbours = np.sort(tiny[1:4, 1:4], axis=None)
print("the nine, sorted:", neighbours, "  the fifth:", neighbours[4])

assert neighbours[4] == 53

# %%
cleaned = median_blur(tiny, 3)
show([tiny, box_blur(tiny, 3), cleaned], ["with salt and pepper", "3 × 3 mean", "3 × 3 median"], encoding="mono8",
     caption="The mean spreads both wrong pixels over their neighbours; the median removes them and keeps the edge.",
     alt="Three grids of numbers: a white and a black pixel stand out in the first, and are gone in the third.")

assert cleaned[2, 2] == 53 and cleaned[1, 4] == 200

# %% [markdown]
# A pixel at the border has no neighbours outside the image. So a filter needs a rule for them: its **border handling**. Three rules are common:
#
# - *replicate* repeats the outermost pixel; OpenCV's median uses it,
# - *reflect-101* mirrors the image about its outermost pixel; OpenCV's box and Gaussian filters use it,
# - *zero padding* adds zeros; it makes the border darker.

# %%
border_row = np.array([10, 20, 30])
for rule, mode in {"replicate": "edge", "reflect-101": "reflect", "zero padding": "constant"}.items():
    print(f"{rule:13}", np.pad(border_row, 2, mode=mode))

assert np.pad(border_row, 2, mode="edge").tolist() == [10, 10, 10, 20, 30, 30, 30]
assert np.pad(border_row, 2, mode="reflect").tolist() == [30, 20, 10, 20, 30, 20, 10]
assert np.pad(border_row, 2, mode="constant").tolist() == [0, 0, 10, 20, 30, 0, 0]

# %% [markdown]
# The 3 × 3 mean is the **box filter** (mean filter): all nine weights are 1/9. The **Gaussian filter** gives near neighbours more weight. Its 3 × 3 kernel is 1, 2, 1 down the column times 1, 2, 1 along the row, divided by 16. So it is a **separable** filter: a pass along the rows and then a pass down the columns give the same result as the whole kernel, with 3 + 3 products per pixel instead of 9. The median has no kernel: it sorts, and no weighted sum can do that.
#
# **Predict** the response to a single pixel of 160: it shows the kernel, ten times.

# %%
bump = np.zeros((5, 5), np.uint8)
bump[2, 2] = 160
response = gaussian_blur(bump, 0, size=3)
show([bump, response], ["one pixel of 160", "3 × 3 Gaussian filter"], encoding="mono8",
     caption="The response to one bright pixel is the kernel itself: here 1, 2, 4 times 10.",
     alt="Two grids: a single 160 in the middle; around it 10, 20, 10, then 20, 40, 20, then 10, 20, 10.")

assert (response[1:4, 1:4] == 10 * np.outer([1, 2, 1], [1, 2, 1])).all()
assert response.sum() == 160  # the weights add up to 1, so the sum stays

# %% [markdown]
# ## 5 · Four filters, two kinds of noise (8 minutes)
#
# Now a camera frame, with random noise that has a fixed seed, so everybody gets the same noise. **Gaussian noise** changes every pixel by a normally distributed error. Besides box, Gaussian and median we try the **bilateral filter**. It is a weighted mean like the Gaussian filter, but neighbours with a very different gray level get almost no weight. So it keeps steps sharp.

# %%
salted = add_salt_and_pepper(gray, 0.05, seed=1)
grainy = add_gaussian_noise(gray, 20, seed=1)
changed = (salted != gray).mean()
print(f"salt and pepper: {changed:.1%} of the pixels changed;  Gaussian: {(grainy != gray).mean():.1%}")

assert 0.04 < changed < 0.06 and (grainy != gray).mean() > 0.95

# %%
part = dict(rows=(310, 440), cols=(430, 740))
show([salted, grainy], ["salt and pepper", "Gaussian, 20 gray levels"], encoding="mono8", **part,
     caption="Left, few pixels are wrong, but completely; right, nearly every pixel is a little wrong.",
     alt="The ball and the marker twice: left with single white and black pixels, right with an even grain.")

# %% [markdown]
# **Predict** which filter removes the left noise best, and which one the right noise.

# %%
filters = {
    "box 3": lambda image: box_blur(image, 3),
    "Gaussian 1.5": lambda image: gaussian_blur(image, 1.5),
    "median 3": lambda image: median_blur(image, 3),
    "bilateral": lambda image: bilateral_filter(image, 50, 2),
}
show([apply(salted) for apply in filters.values()], list(filters), encoding="mono8", **part, columns=2,
     caption="Impulse noise after four filters: only the median removes it.",
     alt="Ball and marker four times; the wrong pixels are blurred in the first two, still there in the fourth, and gone in the third.")

# %%
show([apply(grainy) for apply in filters.values()], list(filters), encoding="mono8", **part, columns=2,
     caption="Gaussian noise after four filters: all reduce it, and the bilateral filter keeps the marker sharp.",
     alt="Ball and marker four times, with less grain than before; the edges of the fourth are the sharpest.")

# %% [markdown]
# ## 6 · How much noise is left? (8 minutes)
#
# "Looks better" is not a measurement. A **signal-to-noise ratio** is one: how large is the image signal compared with its errors? The **PSNR** (peak signal-to-noise ratio) takes the largest possible gray level, 255, as the signal. The error is the *mean squared error* (MSE): the difference of each pixel to the clean image, squared, and averaged over all pixels.
#
# $$\text{PSNR} = 10 \log_{10} \frac{255^2}{\text{MSE}} \quad\text{in decibel (dB); a higher value means less noise}$$
#
# By hand on four pixels:

# %%
four_clean = np.array([[100, 100], [100, 100]], dtype=np.uint8)
four_noisy = np.array([[100, 110], [90, 100]], dtype=np.uint8)
squared = (four_clean.astype(float) - four_noisy) ** 2
mse = squared.mean()
print("squared differences:", squared.ravel(), "  their mean:", mse)
print("PSNR:", round(10 * np.log10(255**2 / mse), 1), "dB")

assert mse == 50 and round(10 * np.log10(255**2 / mse), 1) == 31.1
assert psnr(four_clean, four_noisy) == 10 * np.log10(255**2 / mse)

# %% [markdown]
# **Check** your predictions of section 5 with numbers. The table also shows **SSIM** (structural similarity). It compares local mean, contrast and pattern of two images; 1 means equal.

# %%
print(f"{'':14}{'salt and pepper':>22}{'Gaussian':>20}")
print(f"{'untouched':14}{psnr(gray, salted):>16.1f} dB {psnr(gray, grainy):>16.1f} dB")
score = {}
for name, apply in filters.items():
    score[name] = psnr(gray, apply(salted)), psnr(gray, apply(grainy))
    similarity = ssim(gray, apply(salted)), ssim(gray, apply(grainy))
    print(f"{name:14}{score[name][0]:>16.1f} dB {score[name][1]:>16.1f} dB   SSIM {similarity[0]:.2f}, {similarity[1]:.2f}")

assert max(score, key=lambda name: score[name][0]) == "median 3"
assert max(score, key=lambda name: score[name][1]) == "Gaussian 1.5"

# %% [markdown]
# There is no best filter for every noise. Against impulse noise the median is better than the others by more than ten decibels. Against Gaussian noise the Gaussian filter is the best of the four. First look at the noise, then choose.

# %%
second_best = max(score[name][0] for name in score if name != "median 3")
assert score["median 3"][0] - second_best > 10

# %% [markdown]
# Once more on a photograph: an astronaut, a public-domain photograph by NASA from the example images of scikit-image.

# %%
from skimage import data

portrait = to_gray(data.astronaut()[..., ::-1])
salted_portrait = add_salt_and_pepper(portrait, 0.05, seed=2)
show([salted_portrait, median_blur(salted_portrait, 3)], ["salt and pepper", "3 × 3 median"], rows=(0, 300), cols=(100, 400),
     caption="The median on a photograph: it removes the noise, but also fine details such as the eyelashes.",
     alt="The face of a smiling astronaut, with white and black pixels on the left and without them on the right.")

assert psnr(portrait, median_blur(salted_portrait, 3)) > psnr(portrait, salted_portrait) + 10

# %% [markdown]
# ## 7 · Your turn: the median by hand (8 minutes)
#
# Write `median3(gray)`: each pixel becomes the median of its 3 × 3 neighbourhood. At the border use *replicate*: repeat the outermost rows and columns.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: (height, width) uint8 | a new (height, width) uint8 array | `cleaned = median3(tiny)` |

# %% role="exercise"
exercise(
    "noise-median",
    title="The 3 × 3 median",
    function="median3",
    time_limit=10,
    refused=("cv2", "scipy", "skimage", "imgproc_course.imaging"),
    hint="Pad by one with np.pad(gray, 1, mode='edge'), stack the nine shifted arrays, and take np.median over the stack.",
)

# %% role="answer"
def median3(gray):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 1, mode="edge")
    shifted = [padded[row : row + height, col : col + width] for row in range(3) for col in range(3)]
    return np.median(shifted, axis=0).astype(np.uint8)


# %% role="check"
check("noise-median", median3)


# %% role="case" title="one wrong pixel" points=1 hint="The wrong pixel must disappear, and the other pixels may change only a little."
def inputs(rng):
    image = rng.integers(90, 110, size=(5, 6), dtype=np.uint8)
    image[rng.integers(1, 4), rng.integers(1, 5)] = 255
    return (image,)


# %% role="case" title="wrong pixels at the border" points=1 hint="At the border the outermost row and column are repeated, not filled with zeros."
def inputs(rng):
    image = rng.integers(90, 200, size=(5, 5), dtype=np.uint8)
    image[0, rng.integers(0, 5)] = 255
    image[rng.integers(0, 5), 4] = 0
    return (image,)


# %% role="hidden" title="a larger image" points=1 hint="Does your function work if height and width are very different?"
def inputs(rng):
    return (rng.integers(0, 256, size=(20, 33), dtype=np.uint8),)


# %% role="hidden" title="a single row" points=1 hint="What are the neighbours in an image with only one row?"
def inputs(rng):
    return (rng.integers(0, 256, size=(1, 12), dtype=np.uint8),)


# %% role="mistake" name="a mean instead of a median" says="This is the mean of the nine values. It spreads a wrong pixel over its neighbours. The median is the fifth of the nine values when they are sorted."
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 1, mode="edge")
    shifted = [padded[row : row + height, col : col + width] for row in range(3) for col in range(3)]
    return np.mean(shifted, axis=0).astype(np.uint8)


# %% role="mistake" name="a border of zeros" says="The image was padded with zeros, and they change the medians at the border. Repeat the outermost rows and columns: np.pad(gray, 1, mode='edge')."
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 1)
    shifted = [padded[row : row + height, col : col + width] for row in range(3) for col in range(3)]
    return np.median(shifted, axis=0).astype(np.uint8)


# %% role="mistake" name="rows alone" says="Only neighbours in the same row were used. A neighbourhood is three rows by three columns."
def median3(gray):
    width = gray.shape[1]
    padded = np.pad(gray, ((0, 0), (1, 1)), mode="edge")
    return np.median([padded[:, col : col + width] for col in range(3)], axis=0).astype(np.uint8)


# %% role="mistake" name="the border is left out" says="The result is smaller than the image: the outermost pixels are missing. Pad before you take the neighbours."
def median3(gray):
    height, width = gray.shape
    shifted = [gray[row : row + height - 2, col : col + width - 2] for row in range(3) for col in range(3)]
    return np.median(shifted, axis=0).astype(np.uint8) if height > 2 else gray.copy()


# %% [markdown]
# ## 8 · Your turn: PSNR (5 minutes)
#
# Write `my_psnr(clean, other)` with the formula of section 6. Remember what `uint8` does to a difference. For equal images the result is infinity, `float("inf")`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `clean`, `other`: two (height, width) uint8 images of the same shape | one float, in decibel | `my_psnr(four_clean, four_noisy)` |

# %% role="exercise"
exercise(
    "noise-psnr",
    title="PSNR",
    function="my_psnr",
    time_limit=5,
    refused=("cv2", "skimage", "imgproc_course.imaging"),
    hint="Widen both images to float before you subtract.",
)

# %% role="answer"
def my_psnr(clean, other):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    return float("inf") if mse == 0 else float(10 * np.log10(255**2 / mse))


# %% role="check"
check("noise-psnr", my_psnr)


# %% role="case" title="a brighter image" points=1 tolerance=1e-6 hint="The differences are squared, then averaged."
def inputs(rng):
    clean = rng.integers(0, 200, size=(4, 5), dtype=np.uint8)
    return clean, clean + rng.integers(1, 50, size=(4, 5), dtype=np.uint8)


# %% role="case" title="a darker image" points=1 tolerance=1e-6 hint="In uint8, 100 - 110 is 246: widen first."
def inputs(rng):
    clean = rng.integers(60, 256, size=(4, 5), dtype=np.uint8)
    return clean, clean - rng.integers(1, 60, size=(4, 5), dtype=np.uint8)


# %% role="hidden" title="equal images" points=1 hint="Do not divide by zero: return infinity if the mean squared error is 0."
def inputs(rng):
    clean = rng.integers(0, 256, size=(6, 6), dtype=np.uint8)
    return clean, clean.copy()


# %% role="mistake" name="uint8 wraps" says="This is what uint8 wrap-around looks like: 100 - 110 gave 246. Widen to float before you subtract."
def my_psnr(clean, other):
    mse = np.mean(((clean - other).astype(float)) ** 2)
    return float("inf") if mse == 0 else float(10 * np.log10(255**2 / mse))


# %% role="mistake" name="the natural logarithm" says="np.log is the natural logarithm. Decibels use the logarithm to base 10: np.log10."
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    return float("inf") if mse == 0 else float(10 * np.log(255**2 / mse))


# %% role="mistake" name="the peak is not squared" says="The peak, 255, must be squared like the differences: 255**2 / MSE."
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    return float("inf") if mse == 0 else float(10 * np.log10(255 / mse))


# %% [markdown]
# ## 9 · Practice: choose a filter (5 minutes)
#
# Write `best_filter(clean, noisy, filters)`: which filter gives the highest PSNR against `clean`? This exercise gives no points. But with every new camera you will have to choose a filter like this.
#
# | Input | Output | Example call |
# |---|---|---|
# | `clean`, `noisy`: two (height, width) uint8 images; `filters`: a dictionary name → function | the *name* of the best filter, a string | `best_filter(gray, salted, filters)` |

# %% role="exercise"
exercise(
    "noise-choose",
    title="Choose a filter",
    function="best_filter",
    practice=True,
    time_limit=10,
    hint="Compute the PSNR of the result of each filter, and keep the name with the largest PSNR.",
)

# %% role="answer"
def best_filter(clean, noisy, filters):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def best_filter(clean, noisy, filters):
    def mean_squared_error(name):
        return np.mean((filters[name](noisy).astype(float) - clean) ** 2)

    return min(filters, key=mean_squared_error)


# %% role="check"
check("noise-choose", best_filter)


# %% role="case" title="a brightened image"
def inputs(rng):
    clean = rng.integers(0, 200, size=(8, 8), dtype=np.uint8)
    noisy = clean + np.uint8(20)

    def darker_by_twenty(image):
        return image - np.uint8(20)

    def darker_by_ten(image):
        return image - np.uint8(10)

    return clean, noisy, {"darker by ten": darker_by_ten, "darker by twenty": darker_by_twenty}


# %% role="hidden" title="a darkened image" hint="The filter with the largest PSNR may be anywhere in the dictionary."
def inputs(rng):
    clean = rng.integers(100, 200, size=(8, 8), dtype=np.uint8)
    noisy = clean - np.uint8(30)

    def brighter_by_thirty(image):
        return image + np.uint8(30)

    def brighter_by_ten(image):
        return image + np.uint8(10)

    return clean, noisy, {"brighter by thirty": brighter_by_thirty, "brighter by ten": brighter_by_ten}


# %% role="mistake" name="the worst instead of the best" says="This is the filter with the lowest PSNR. A higher PSNR is better."
def best_filter(clean, noisy, filters):
    return max(filters, key=lambda name: np.mean((filters[name](noisy).astype(float) - clean) ** 2))


# %% [markdown]
# ## Recap
#
# A mean reduces Gaussian noise, but blurs edges. A median removes impulse noise and keeps edges. Measure before you choose.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *gray* | (720, 1280) | uint8 | 0 to 255 | gray level |
# | noisy | (720, 1280) | uint8 | 0 to 255 | gray level |
# | filtered | (720, 1280) | uint8 | 0 to 255 | gray level |
# | MSE | one number | float64 | 0 to 65,025 | gray level squared |
# | PSNR | one number | float64 | 0 to infinity | decibel |

# %%
for image in (salted, grainy, *[apply(grainy) for apply in filters.values()]):
    assert image.shape == (720, 1280) and image.dtype == np.uint8
assert 255**2 == 65_025 and isinstance(psnr(gray, salted), float)
