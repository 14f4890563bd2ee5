# ---
# jupyter:
#   imgproc_course:
#     title: Noise removal
#     minutes: 70
# ---

# %% [markdown]
# # 05 · Noise removal
#
# Every sensor adds *noise*: small or large errors in the gray levels. A *filter* removes noise. It computes each pixel of a new image from the pixel at the same place in the old image and its neighbours. Which filter helps depends on the kind of noise.
#
# **You will be able to**
# - distinguish Gaussian noise from impulse noise by the errors of the pixels,
# - explain kernel, correlation, convolution and border handling,
# - explain why a mean blurs edges and why a median does not,
# - compute a 3 × 3 median by hand,
# - measure with PSNR which filter removes more noise, and choose a filter with this number.
#
# **Time** about 70 minutes. **You need** lesson 03.

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
# **Ask.** A wall has one colour. Does the camera see one gray level? Here are 8 × 8 pixels of the wall. **Predict**: are they all equal? If not, how much do they differ? (The *standard deviation* in the output is the typical distance of a value from the mean.)

# %%
wall = gray[120:128, 880:888]
show(wall, "a piece of the wall", encoding="mono8",
     caption="The wall has one colour, but the numbers differ: this is the noise of the sensor.",
     alt="An eight by eight grid of nearly equal gray squares with their numbers.")
print("smallest", wall.min(), "  largest", wall.max(), "  standard deviation", round(float(wall.std()), 1), "gray levels")

assert 0 < wall.std() < 5

# %% [markdown]
# ## 2 · A row with an intensity step (10 minutes)
#
# An image consists of many rows, and one row is easier to read. Here is a row with a dark part, a bright part and an *intensity step* between them: the place where the gray level (the intensity) jumps. We add an error of a few gray levels to each value.

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
    padded = np.pad(row, 1, mode="edge")  # repeats the first and the last value
    # left neighbour + value + right neighbour; // divides and drops the fraction
    return (padded[:-2] + padded[1:-1] + padded[2:]) // 3


averaged = mean_of_three(noisy_row)
print("noisy", noisy_row)
print("mean ", averaged)

assert np.abs(averaged[:5] - 50).max() < np.abs(noisy_row[:5] - 50).max()
assert averaged[5] == 101 and averaged[6] == 146

# %% [markdown]
# The flat parts are smoother, but we lost the sharp edge. Between 50 and 200 there are now 101 and 146. No pixel of the clean row has such a value.
#
# This mean is a **correlation** with a **kernel**: the list of weights 1/3, 1/3, 1/3. (This *filter kernel* is unrelated to the notebook's kernel, which runs your cells.) The kernel moves along the row. At each pixel, every weight is multiplied by the value under it, and the products are added. The sum is the **filter response** at this pixel.
#
# A **convolution** does the same, but flips the kernel first (left becomes right). With a symmetric kernel both give the same response; with any other kernel they differ. A row of zeros with a single 1, an *impulse*, shows the difference: the convolution returns the kernel as it is, and the correlation returns the flipped kernel.

# %%
impulse = np.array([0, 0, 0, 1, 0, 0, 0])
kernel = [1, 2, 3]
print("convolution", np.convolve(impulse, kernel, mode="same"))
print("correlation", np.correlate(impulse, kernel, mode="same"))

assert np.convolve(impulse, kernel, mode="same").tolist() == [0, 0, 1, 2, 3, 0, 0]
assert np.correlate(impulse, kernel, mode="same").tolist() == [0, 0, 3, 2, 1, 0, 0]
assert (np.correlate(impulse, kernel[::-1], mode="same") == np.convolve(impulse, kernel, mode="same")).all()

# %% [markdown]
# OpenCV's filters compute the correlation. Most textbooks use the convolution. For the symmetric kernels of this lesson the results are equal; for the kernel of lesson 07 they have opposite signs.
#
# ## 3 · Planned failure: a mean filter against impulse noise (6 minutes)
#
# Some sensor errors are not small: a broken pixel is black or white. This is **impulse noise**, also called *salt-and-pepper* noise. **Predict** what the mean of three does to a single white pixel (255) in a row of 50.

# %%
salted_row = np.array([50, 50, 50, 50, 255, 50, 50, 50, 50])
print("salted", salted_row)
print("mean  ", mean_of_three(salted_row))

assert mean_of_three(salted_row).tolist() == [50, 50, 50, 118, 118, 118, 50, 50, 50]

# %% [markdown]
# One wrong pixel became three wrong pixels. **Repair it**: do not average. Sort the three values and take the middle one: the **median**. A single *outlier* (a value far from all others) is the smallest or the largest of the three, so it is never in the middle.

# %%
def median_of_three(row):
    padded = np.pad(row, 1, mode="edge")
    # axis=0 sorts the three values of each pixel; [1] is the middle one
    return np.sort([padded[:-2], padded[1:-1], padded[2:]], axis=0)[1]


print("salted", salted_row)
print("median", median_of_three(salted_row))
print("step  ", median_of_three(clean_row))

assert (median_of_three(salted_row) == 50).all()
assert (median_of_three(clean_row) == clean_row).all()  # the step is still a step

# %% [markdown]
# ## 4 · From a row to an image (10 minutes)
#
# In an image a pixel has neighbours on all sides: a neighbourhood of 3 × 3 = 9 values. If you sort them, the median is the fifth value. **Predict** the median of the nine values around the 255 in the middle of this image.

# %%
tiny = np.array([[50, 52, 51, 200, 201],
                 [49, 50, 53, 198, 0],
                 [51, 50, 255, 202, 200],
                 [50, 52, 50, 199, 201],
                 [48, 50, 51, 200, 202]], dtype=np.uint8)
neighbours = np.sort(tiny[1:4, 1:4], axis=None)  # axis=None: sort all nine values as one list
print("the nine, sorted:", neighbours, "  the fifth:", neighbours[4])

assert neighbours[4] == 53

# %%
cleaned = median_blur(tiny, 3)
show([tiny, box_blur(tiny, 3), cleaned], ["with salt and pepper", "3 × 3 mean", "3 × 3 median"], encoding="mono8",
     caption="The mean spreads the two wrong pixels over their neighbours; the median removes them and keeps the edge.",
     alt="Three grids of numbers: the first has one white and one black pixel that do not fit; in the third they are gone.")

assert cleaned[2, 2] == 53 and cleaned[1, 4] == 200

# %% [markdown]
# A pixel at the border has fewer neighbours, because there are no pixels outside the image. So a filter needs a rule for the missing neighbours: its **border handling**. Three rules are common (`np.pad` calls them `edge`, `reflect` and `constant`):
#
# - *replicate* repeats the outermost pixel; OpenCV's median filter uses it,
# - *reflect-101* mirrors the image at its outermost pixel, without repeating this pixel; OpenCV's box and Gaussian filters use it,
# - *zero padding* adds zeros; a mean filter then makes the border darker.

# %%
border_row = np.array([10, 20, 30])
for rule, mode in {"replicate": "edge", "reflect-101": "reflect", "zero padding": "constant"}.items():
    print(f"{rule:13}", np.pad(border_row, 2, mode=mode))

assert np.pad(border_row, 2, mode="edge").tolist() == [10, 10, 10, 20, 30, 30, 30]
assert np.pad(border_row, 2, mode="reflect").tolist() == [30, 20, 10, 20, 30, 20, 10]
assert np.pad(border_row, 2, mode="constant").tolist() == [0, 0, 10, 20, 30, 0, 0]

# %% [markdown]
# The 3 × 3 mean is the **box filter** (or mean filter): all nine weights are 1/9. The **Gaussian filter** gives near neighbours more weight. Its 3 × 3 kernel is 1, 2, 1 down the column times 1, 2, 1 along the row, divided by 16. So it is a **separable** filter: you can filter first along the rows and then down the columns, and get the same result as with the whole kernel. This needs 3 + 3 products per pixel instead of 9. The median filter has no kernel: it sorts, and a weighted sum cannot sort.
#
# **Predict** the response to a single pixel of 160 in a black image. (160 / 16 is 10.)

# %%
bump = np.zeros((5, 5), np.uint8)
bump[2, 2] = 160
response = gaussian_blur(bump, 0, size=3)
show([bump, response], ["one pixel of 160", "3 × 3 Gaussian filter"], encoding="mono8",
     caption="The response to one bright pixel is the kernel itself: here 1, 2, 4 times 10.",
     alt="Two grids: a single 160 in the middle; around it 10, 20, 10, then 20, 40, 20, then 10, 20, 10.")

assert 160 / 16 == 10
assert (response[1:4, 1:4] == 10 * np.outer([1, 2, 1], [1, 2, 1])).all()
assert response.sum() == 160  # the weights add up to 1, so the sum stays

# %% [markdown]
# ## 5 · Four filters, two kinds of noise (8 minutes)
#
# Now we add random noise to a camera frame. The *seed* of the random numbers is fixed, so everybody gets the same noise. **Gaussian noise** adds a random error to every pixel. The errors have a normal distribution: small errors are common, large ones are rare. We try the box, the Gaussian and the median filter, and also the **bilateral filter**. It is a weighted mean like the Gaussian filter, but neighbours with a very different gray level get almost no weight. So it keeps steps sharp.

# %%
salted = add_salt_and_pepper(gray, 0.05, seed=1)  # 5 % of the pixels become black or white
grainy = add_gaussian_noise(gray, 20, seed=1)  # standard deviation 20 gray levels
changed = (salted != gray).mean()
print(f"changed pixels: salt and pepper {changed:.1%}, Gaussian {(grainy != gray).mean():.1%}")

assert 0.04 < changed < 0.06 and (grainy != gray).mean() > 0.95

# %%
part = dict(rows=(310, 440), cols=(430, 740))  # **part below passes both to show, which draws only this part
show([salted, grainy], ["impulse noise (salt and pepper)", "Gaussian noise, 20 gray levels"], encoding="mono8", **part,
     caption="Left, a few pixels are completely wrong; right, nearly every pixel is a little wrong.",
     alt="The ball and the marker twice: left with single white and black pixels, right with fine noise all over.")

# %% [markdown]
# **Predict** which of four filters is best against impulse noise, and which is best against Gaussian noise.

# %%
filters = {  # name: function; "lambda image: ..." is a short way to write a function
    "box 3": lambda image: box_blur(image, 3),  # 3 × 3 pixels
    "Gaussian 1.5": lambda image: gaussian_blur(image, 1.5),  # the kernel's standard deviation is 1.5 pixels
    "median 3": lambda image: median_blur(image, 3),  # 3 × 3 pixels
    "bilateral": lambda image: bilateral_filter(image, 50, 2),  # 50 gray levels, 2 pixels
}
show([apply(salted) for apply in filters.values()], list(filters), encoding="mono8", **part, columns=2,
     caption="Impulse noise after four filters: only the median removes it.",
     alt="Ball and marker four times: the wrong pixels are blurred in the first two, gone in the third, and still there in the fourth.")

# %%
show([apply(grainy) for apply in filters.values()], list(filters), encoding="mono8", **part, columns=2,
     caption="Gaussian noise after four filters: all four reduce it, and the bilateral filter keeps the marker sharp.",
     alt="Ball and marker four times, with less noise than before; the edges of the fourth are the sharpest.")

# %% [markdown]
# ## 6 · How much noise is left? (8 minutes)
#
# "It looks better" is not a measurement. A **signal-to-noise ratio** is a measurement: it compares the size of the signal with the size of the errors. The **PSNR** (peak signal-to-noise ratio) takes the largest possible gray level, 255, as the signal. It measures the errors with the *mean squared error* (MSE): take the difference between each pixel and the same pixel of the clean image, square it, and average over all pixels.
#
# $$\text{PSNR} = 10 \log_{10} \frac{255^2}{\text{MSE}} \quad\text{in decibel (dB)}$$
#
# A higher PSNR means less noise: if the MSE becomes ten times smaller, the PSNR rises by 10 dB. By hand on four pixels:

# %%
four_clean = np.array([[100, 100], [100, 100]], dtype=np.uint8)
four_noisy = np.array([[100, 110], [90, 100]], dtype=np.uint8)
squared = (four_clean.astype(float) - four_noisy) ** 2
mse = squared.mean()
print("squared differences:", squared.ravel(), "  MSE, their mean:", mse)
print("PSNR:", round(10 * np.log10(255**2 / mse), 1), "dB")

assert mse == 50 and round(10 * np.log10(255**2 / mse), 1) == 31.1
assert psnr(four_clean, four_noisy) == 10 * np.log10(255**2 / mse)
assert round(10 * np.log10(255**2 / (mse / 10)) - psnr(four_clean, four_noisy), 9) == 10

# %% [markdown]
# **Check** your predictions of section 5 with numbers. The table also shows the **SSIM** (structural similarity). It compares the local mean, contrast and structure of two images; for equal images it is 1.

# %%
print(f"{'':14}{'salt and pepper':>22}{'Gaussian':>20}")
print(f"{'no filter':14}{psnr(gray, salted):>16.1f} dB {psnr(gray, grainy):>16.1f} dB")
score = {}
for name, apply in filters.items():
    score[name] = psnr(gray, apply(salted)), psnr(gray, apply(grainy))
    similarity = ssim(gray, apply(salted)), ssim(gray, apply(grainy))
    print(f"{name:14}{score[name][0]:>16.1f} dB {score[name][1]:>16.1f} dB   SSIM {similarity[0]:.2f}, {similarity[1]:.2f}")

assert max(score, key=lambda name: score[name][0]) == "median 3"
assert max(score, key=lambda name: score[name][1]) == "Gaussian 1.5"

# %% [markdown]
# No filter is the best for every kind of noise. Against impulse noise the median is better than the others by more than ten decibels. Against Gaussian noise the Gaussian filter is the best of the four. First look at the noise, then choose.

# %%
second_best = max(score[name][0] for name in score if name != "median 3")
assert score["median 3"][0] - second_best > 10

# %% [markdown]
# The same on a photograph of an astronaut. NASA took it, it is in the public domain, and scikit-image contains it.

# %%
from skimage import data

portrait = to_gray(data.astronaut()[..., ::-1])
salted_portrait = add_salt_and_pepper(portrait, 0.05, seed=2)
show([salted_portrait, median_blur(salted_portrait, 3)], ["salt and pepper", "3 × 3 median"], rows=(0, 300), cols=(100, 400),
     caption="The median on a photograph: it removes the noise, but also fine details such as the eyelashes.",
     alt="The face of a smiling astronaut, with white and black pixels on the left and without them on the right.")

assert psnr(portrait, median_blur(salted_portrait, 3)) > psnr(portrait, salted_portrait) + 10

# %% [markdown]
# ## 7 · Your turn: the median by hand (10 minutes)
#
# Write `median3(gray)`: each pixel becomes the median of its 3 × 3 neighbourhood. At the border use *replicate*: repeat the outermost rows and columns. Use only NumPy.
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


# %% role="case" title="one wrong pixel" points=1 hint="The wrong pixel must disappear, and the other pixels must change only a little."
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


# %% role="mistake" name="zero padding at the border" says="The image was padded with zeros, and these zeros change the medians at the border. Repeat the outermost rows and columns: np.pad(gray, 1, mode='edge')."
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 1)
    shifted = [padded[row : row + height, col : col + width] for row in range(3) for col in range(3)]
    return np.median(shifted, axis=0).astype(np.uint8)


# %% role="mistake" name="only neighbours in the row" says="Only neighbours in the same row were used. A neighbourhood is three rows by three columns."
def median3(gray):
    width = gray.shape[1]
    padded = np.pad(gray, ((0, 0), (1, 1)), mode="edge")
    return np.median([padded[:, col : col + width] for col in range(3)], axis=0).astype(np.uint8)


# %% role="mistake" name="no border handling" says="The result is smaller than the image: the outermost pixels are missing. Pad before you take the neighbours."
def median3(gray):
    height, width = gray.shape
    shifted = [gray[row : row + height - 2, col : col + width - 2] for row in range(3) for col in range(3)]
    return np.median(shifted, axis=0).astype(np.uint8) if height > 2 else gray.copy()


# %% [markdown]
# ## 8 · Your turn: PSNR (8 minutes)
#
# Write `my_psnr(clean, other)` with the formula of section 6. Remember what `uint8` does to a difference. For equal images the result is infinity, `float("inf")`. Use only NumPy.
#
# | Input | Output | Example call |
# |---|---|---|
# | `clean`, `other`: two (height, width) uint8 images of the same shape | one float: the PSNR in decibel | `my_psnr(four_clean, four_noisy)` |

# %% role="exercise"
exercise(
    "noise-psnr",
    title="PSNR",
    function="my_psnr",
    time_limit=5,
    refused=("cv2", "skimage", "imgproc_course.imaging"),
    hint="Convert both images to float before you subtract.",
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


# %% role="mistake" name="uint8 wraps" says="This is uint8 wrap-around: 100 - 110 gave 246. Convert both images to float before you subtract."
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
# Write `best_filter(clean, noisy, filters)`. It applies every filter to `noisy`, and returns the name of the filter whose result has the highest PSNR compared with `clean`. This exercise gives no points. But for every new camera you will have to choose a filter in this way.
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
    hint="Apply each filter, compute the PSNR of the result, and keep the name with the highest PSNR.",
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


# %% role="hidden" title="a darkened image" hint="The best filter may be the first or the last in the dictionary."
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
