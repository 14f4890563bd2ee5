# ---
# jupyter:
#   imgproc_course:
#     title: Noise removal
# ---

# %% [markdown]
# # Noise removal
#
# Every sensor adds [[term:noise]]: small or large errors in the gray levels. A *filter* removes noise. It computes each pixel of a new image from the pixel at the same place in the old image and its neighbours. Which filter helps depends on the kind of noise.
#
# **You will be able to**
# - distinguish Gaussian noise from impulse noise,
# - explain kernel, correlation and border handling,
# - explain why a mean blurs edges and why a median does not,
# - compute a 3 × 3 median by hand,
# - measure with PSNR which filter removes more noise, and choose a filter with this number.
#
# **Time** [[minutes]]; take a break after section 4, and one after section 7. **You need** [[arrays]] and [[grayscale]].

# %% role="given" exercise=["noise-median", "noise-psnr"]
import numpy as np

# %%
from imgproc_course.display import show
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.imaging import add_gaussian_noise, add_salt_and_pepper
from imgproc_course.imaging import bilateral_filter, box_blur
from imgproc_course.imaging import gaussian_blur, median_blur
from imgproc_course.imaging import psnr, to_gray
from imgproc_course.recording import open_recording

# %% role="texts"
figure_texts = {
    "wall": (
        "The wall has one colour, but the numbers differ: this is the noise of the sensor.",
        "An eight by eight grid of nearly equal gray squares with their numbers.",
    ),
    "shifted": (
        "Each column holds the three values that belong together: the left neighbour above, the pixel in the middle, the right neighbour below.",
        "Three rows of twelve numbers: the same row three times, each time shifted by one column.",
    ),
    "nine": (
        "The image, the padded image, and the 3 × 3 window of the top left pixel. In the window the pixel itself, 50, is in the middle.",
        "Three grids of numbers: five by five, seven by seven with repeated outermost numbers, and three by three.",
    ),
    "tiny": (
        "The mean spreads the two wrong pixels over their neighbours; the median removes them and keeps the edge.",
        "Three grids of numbers: the first has one white and one black pixel that do not fit; in the third they are gone.",
    ),
    "bump": (
        "The response to one bright pixel is the kernel itself: here 1, 2, 4 times 10.",
        "Two grids: a single 160 in the middle; around it 10, 20, 10, then 20, 40, 20, then 10, 20, 10.",
    ),
    "two kinds": (
        "Above, a few pixels are completely wrong; below, nearly every pixel is a little wrong.",
        "The ball and the marker twice: above with single white and black pixels, below with fine noise all over.",
    ),
    "impulse": (
        "Impulse noise after four filters: only the median removes it.",
        "The marker four times: the wrong pixels are blurred in the first two, gone in the third, and still there in the fourth.",
    ),
    "gaussian": (
        "Gaussian noise after four filters: all four reduce it, and the bilateral filter keeps the marker sharp.",
        "The marker four times, with less noise than before; the edges of the fourth are the sharpest.",
    ),
}

# %%
recording = open_recording("drive")
gray = to_gray(recording.frame(30))
print(gray.shape, gray.dtype, "range", gray.min(), "to", gray.max())

# %% [markdown]
# ## 1 · Noise is in every image ([[minutes]])
#
# A wall has one colour. Does the camera see one gray level? We look at 8 × 8 pixels of the wall.
#
# **Predict** the difference between the brightest and the darkest of these 64 pixels, in gray levels.

# %% role="predict"
guess_range = None  # your guess: how many gray levels?

# %%
wall = gray[120:128, 880:888]
show(wall, "a piece of the wall", text="noise_removal/wall")
compare_guess(guess_range, int(wall.max()) - int(wall.min()), "gray levels")

# %% [markdown]
# One number for the strength of the noise is the **standard deviation**: the typical distance of a value from the mean. Subtract the mean from each value, square the differences, take their mean, take the square root. By hand on four values, and with NumPy's `std`:

# %%
four = np.array([98, 102, 97, 103])
differences = four - four.mean()
print("differences from the mean:", differences)
print("by hand:", round(np.sqrt((differences**2).mean()), 2))
print("std:    ", round(four.std(), 2), "  the wall:", round(wall.std(), 2))

# %%
# Check: the numbers in this section
assert four.mean() == 100 and four.std() == np.sqrt((differences**2).mean())
assert 0 < wall.std() < 5 and 0 < int(wall.max()) - int(wall.min()) < 20

# %% [markdown]
# ## 2 · A row with an intensity step ([[minutes]])
#
# Here is a row with a dark part, a bright part and an *intensity step* between them: the place where the gray level (the intensity) jumps. We add an error of a few gray levels to each value.

# %%
clean_row = np.array([50] * 6 + [200] * 6)
errors = np.array([4, -6, 3, -2, 7, -5, 2, -7, 5, -3, 6, -4])
noisy_row = clean_row + errors
print("clean", clean_row)
print("noisy", noisy_row)

# %% [markdown]
# **Try.** Replace each value by the mean of itself and its two neighbours. As in [[arrays#10]], we take the row three times, each time shifted by one column. The first and the last value are repeated once (`mode="edge"`), because they have only one neighbour.

# %%
padded = np.pad(noisy_row, 1, mode="edge")
shifted = np.stack([padded[:-2], padded[1:-1], padded[2:]])
show(shifted.astype(np.uint8), "left neighbour, pixel, right neighbour",
     text="noise_removal/shifted")

# %%
def mean_of_three(row):
    padded = np.pad(row, 1, mode="edge")
    left, middle, right = padded[:-2], padded[1:-1], padded[2:]
    return (left + middle + right) // 3  # // drops the fraction

# %% [markdown]
# **Predict** the mean of three at index 5. It is the last dark pixel, 45, and its neighbours are 57 and 202.

# %% role="predict"
guess_mean = None  # your guess: which gray level?

# %%
averaged = mean_of_three(noisy_row)
print("noisy", noisy_row)
print("mean ", averaged)
compare_guess(guess_mean, averaged[5])

# %% [markdown]
# The flat parts are smoother: the noise got smaller. But we lost the sharp edge. Between 50 and 200 there are now 101 and 146, values of no pixel of the clean row.
#
# This mean is a **correlation** with a **kernel**: the list of weights 1/3, 1/3, 1/3. (This *filter kernel* is unrelated to the notebook's kernel.) The kernel moves along the row. At each pixel, every weight is multiplied by the value under it, and the products are added. The sum is the **filter response** at this pixel.

# %%
# Check: the numbers in this section
assert noisy_row[4:7].tolist() == [57, 45, 202]
assert np.abs(averaged[:5] - 50).max() < np.abs(errors[:5]).max()
assert averaged[5] == 101 and averaged[6] == 146

# %% [markdown]
# ### Convolution: the flipped kernel ([[minutes]], deeper)
#
# A **convolution** flips the kernel first (left becomes right). A row of zeros with a single 1, an *impulse*, shows the difference.

# %%
impulse = np.array([0, 0, 0, 1, 0, 0, 0])
kernel = [1, 2, 3]
print("convolution", np.convolve(impulse, kernel, mode="same"))
print("correlation", np.correlate(impulse, kernel, mode="same"))

# %% [markdown]
# The convolution returns the kernel as it is, and the correlation returns the flipped kernel. (`mode="same"` gives as many values as the row has.) OpenCV's filters compute the correlation, most textbooks the convolution. For the symmetric kernels of this lesson the results are equal; for the kernel of [[canny_stages]] they have opposite signs.

# %%
# Check: the convolution and the correlation of an impulse
convolved = np.convolve(impulse, kernel, mode="same")
correlated = np.correlate(impulse, kernel, mode="same")
assert convolved.tolist() == [0, 0, 1, 2, 3, 0, 0]
assert correlated.tolist() == [0, 0, 3, 2, 1, 0, 0]
assert (np.correlate(impulse, kernel[::-1], mode="same") == convolved).all()

# %% [markdown]
# ## 3 · Planned failure: a mean filter against impulse noise ([[minutes]])
#
# Some sensor errors are not small: a broken pixel is black or white. This is **[[term:impulse noise]]**, also called *salt-and-pepper* noise. Here is a row of 50 with a single white pixel.
#
# **Predict** how many of the nine values are wrong after the mean of three.

# %% role="predict"
guess_wrong = None  # your guess: how many values are not 50?

# %%
salted_row = np.array([50, 50, 50, 50, 255, 50, 50, 50, 50])
smeared_row = mean_of_three(salted_row)
print("salted", salted_row)
print("mean  ", smeared_row)
compare_guess(guess_wrong, (smeared_row != 50).sum())

# %% [markdown]
# One wrong pixel became three. **Repair it**: do not average. Sort the three values and take the middle one: the **[[term:median]]**. A single *outlier* (a value far from all others) is the smallest or the largest of the three, so it is never in the middle.

# %%
def median_of_three(row):
    padded = np.pad(row, 1, mode="edge")
    shifted = np.stack([padded[:-2], padded[1:-1], padded[2:]])
    # axis=0 sorts each column of three; [1] is the row in the middle
    return np.sort(shifted, axis=0)[1]


print("salted", salted_row)
print("median", median_of_three(salted_row))
print("step  ", median_of_three(clean_row))

# %% [markdown]
# The white pixel is gone, and the step is still a step: between 50 and 200 there is nothing.

# %%
# Check: the numbers in this section
assert smeared_row.tolist() == [50, 50, 50, 118, 118, 118, 50, 50, 50]
assert (median_of_three(salted_row) == 50).all()
assert (median_of_three(clean_row) == clean_row).all()

# %% [markdown]
# ## 4 · From a row to an image ([[minutes]])
#
# In an image, a pixel and its neighbours are 3 × 3 = 9 values. If you sort the nine, the median is the fifth. Here is a dark and a bright area with two wrong pixels, and the neighbourhood of the 255.

# %%
tiny = np.array([[50, 52, 51, 200, 201],
                 [49, 50, 53, 198, 0],
                 [51, 50, 255, 202, 200],
                 [50, 52, 50, 199, 201],
                 [48, 50, 51, 200, 202]], dtype=np.uint8)
window = tiny[1:4, 1:4]
print(window)

# %% [markdown]
# **Predict** the median of these nine values.

# %% role="predict"
guess_median = None  # your guess: which gray level?

# %%
nine = np.sort(window, axis=None)  # axis=None: sort all values as one list
print("sorted:", nine)
compare_guess(guess_median, nine[4])

# %% [markdown]
# (The fifth value has the index 4.) A pixel at the border has fewer neighbours: at a side three of eight are missing, in a corner five. So we pad the image by one pixel first. Then the window of the pixel (row, col) begins at (row, col) of the padded image: for the top left pixel it is `padded[0:3, 0:3]`.

# %%
padded = np.pad(tiny, 1, mode="edge")
row, col = 0, 0
window = padded[row : row + 3, col : col + 3]
show([tiny, padded, window], ["image", "padded", "window of (0, 0)"],
     columns=2, text="noise_removal/nine")
print("sorted:", np.sort(window, axis=None), "  median:", np.median(window))

# %% [markdown]
# A rule for the missing neighbours is called **border handling**. Three rules are common; `np.pad` calls them `edge`, `reflect` and `constant`:
#
# - *replicate* repeats the outermost pixel; OpenCV's median filter uses it,
# - *reflect-101* mirrors the image at its outermost pixel, without repeating this pixel; OpenCV's box and Gaussian filters use it,
# - *zero padding* adds zeros; a mean filter then makes the border darker.

# %%
border_row = np.array([10, 20, 30])
print("replicate   ", np.pad(border_row, 2, mode="edge"))
print("reflect-101 ", np.pad(border_row, 2, mode="reflect"))
print("zero padding", np.pad(border_row, 2, mode="constant"))

# %% [markdown]
# Now the mean and the median of all 25 neighbourhoods of *tiny*:

# %%
cleaned = median_blur(tiny, 3)
show([tiny, box_blur(tiny, 3), cleaned],
     ["with salt and pepper", "3 × 3 mean", "3 × 3 median"],
     columns=2, text="noise_removal/tiny")

# %% [markdown]
# The 3 × 3 mean is the **box filter** (or mean filter): all nine weights are 1/9. The **Gaussian filter** is a mean, too, but near neighbours have more weight than far ones, so it blurs more evenly. Its 3 × 3 kernel, multiplied by 16, is
#
# | 1 | 2 | 1 |
# |---|---|---|
# | **2** | **4** | **2** |
# | **1** | **2** | **1** |
#
# `gaussian_blur(bump, 0, size=3)` uses this kernel. (The second argument is the standard deviation of the kernel; with 0, it follows from the size.)
#
# **Predict** the response in the middle, at a single pixel of 160 in a black image.

# %% role="predict"
guess_response = None  # your guess: which gray level?

# %%
bump = np.zeros((5, 5), np.uint8)
bump[2, 2] = 160
response = gaussian_blur(bump, 0, size=3)
show([bump, response], ["one pixel of 160", "3 × 3 Gaussian filter"],
     text="noise_removal/bump")
compare_guess(guess_response, response[2, 2])

# %% [markdown]
# The weight in the middle is 4/16, and 160 · 4/16 is 40. The median filter has no kernel: it sorts, and a weighted sum cannot sort.

# %%
# Check: the numbers in this section
assert nine.tolist() == [50, 50, 50, 52, 53, 198, 199, 202, 255]
assert cleaned[2, 2] == nine[4] == 53 and cleaned[1, 4] == 200
outside = np.pad(np.zeros((5, 5)), 1, constant_values=1)
assert outside[0:3, 1:4].sum() == 3 and outside[0:3, 0:3].sum() == 5
assert np.median(window) == cleaned[0, 0] == 50 == window[1, 1]
replicated = np.pad(border_row, 2, mode="edge")
assert replicated.tolist() == [10, 10, 10, 20, 30, 30, 30]
mirrored = np.pad(border_row, 2, mode="reflect")
assert mirrored.tolist() == [30, 20, 10, 20, 30, 20, 10]
zero_padded = np.pad(border_row, 2, mode="constant")
assert zero_padded.tolist() == [0, 0, 10, 20, 30, 0, 0]
assert response.sum() == 160 and response[2, 2] == 160 * 4 / 16 == 40

# %% [markdown]
# ### A separable filter ([[minutes]], deeper)
#
# Each number of the Gaussian kernel is a product of 1, 2, 1 down the column and 1, 2, 1 along the row. So the Gaussian filter is **separable**: filter first along the rows and then down the columns. This needs 3 + 3 products per pixel instead of 9.

# %%
# Check: the products
assert (response[1:4, 1:4] == 10 * np.outer([1, 2, 1], [1, 2, 1])).all()

# %% [markdown]
# ## 5 · Two kinds of noise ([[minutes]])
#
# *This is a good place for a break.*
#
# Now we add random noise to a camera frame, with a fixed [[term:seed]], so everybody gets the same noise. Impulse noise makes 5 % of the pixels black or white. **Gaussian noise** adds a random error to every pixel: small errors are common, large ones are rare (a *normal distribution*). Here their standard deviation is 20 gray levels. (In an f-string, `:.1%` writes a share in percent, `:.1f` one digit after the point, and `:10` fills up to ten characters.)

# %%
salted = add_salt_and_pepper(gray, 0.05, seed=1)
grainy = add_gaussian_noise(gray, 20, seed=1)
print(f"changed pixels, impulse noise:  {(salted != gray).mean():.1%}")
print(f"changed pixels, Gaussian noise: {(grainy != gray).mean():.1%}")
show([salted, grainy], ["impulse noise", "Gaussian noise"], columns=1,
     rows=(310, 440), cols=(430, 740), text="noise_removal/two kinds")

# %%
# Check: the numbers in this section
assert 0.04 < (salted != gray).mean() < 0.06
assert (grainy != gray).mean() > 0.95

# %% [markdown]
# ## 6 · How much noise is left? ([[minutes]])
#
# "It looks better" is not a measurement. The *mean squared error* (MSE) is one: take the difference between each pixel and the same pixel of the clean image, square it, and average over all pixels. On four pixels:

# %%
four_clean = np.array([[100, 100], [100, 100]], dtype=np.uint8)
four_noisy = np.array([[100, 110], [90, 100]], dtype=np.uint8)
errors = four_clean.astype(float) - four_noisy.astype(float)
mse = (errors**2).mean()
print("squared errors:", (errors**2).tolist(), "  MSE:", mse)

# %% [markdown]
# A **signal-to-noise ratio** compares the size of the signal with the size of the errors. The **PSNR** (peak signal-to-noise ratio) takes the largest possible gray level, the peak 255, as the signal:
#
# $$\text{PSNR} = 10 \log_{10} \frac{255^2}{\text{MSE}} \quad\text{in decibel (dB)}$$
#
# The logarithm to base 10 counts zeros: it is 1 for 10, 2 for 100 and 3 for 1000. So a ratio of 1000 is 30 dB. A higher PSNR means less noise.

# %%
print("log10:", np.log10(10), np.log10(100), np.log10(1000))
print("255**2 / MSE:", 255**2 / mse)
print("PSNR:", round(10 * np.log10(255**2 / mse), 1), "dB")

# %% [markdown]
# **Predict** by how many dB the PSNR rises if the MSE becomes ten times smaller.

# %% role="predict"
guess_rise = None  # your guess: how many dB?

# %%
before = 10 * np.log10(255**2 / mse)
after = 10 * np.log10(255**2 / (mse / 10))
print("before:", round(before, 1), "dB   after:", round(after, 1), "dB")
compare_guess(guess_rise, round(after - before, 1), "dB")

# %%
# Check: the numbers in this section
assert mse == 50 and round(10 * np.log10(255**2 / mse), 1) == 31.1
assert psnr(four_clean, four_noisy) == before and round(after - before, 9) == 10
assert np.log10([10, 100, 1000]).round(9).tolist() == [1, 2, 3]
assert round(10 * np.log10(1000), 9) == 30

# %% [markdown]
# ## 7 · Four filters ([[minutes]])
#
# We compare the box, the Gaussian and the median filter, and a fourth one, the **bilateral filter**: a weighted mean in which a neighbour has a large weight only if it is near *and* has a similar gray level. So the bright side of a step has almost no weight on the dark side, and the step stays sharp.
#
# Here are the weights of the three values around the last dark pixel of section 2: 57, 45 and 202. The larger the difference from 45, the smaller the weight; a difference of 50 gray levels is large here. The weighted mean is the sum of value times weight, divided by the sum of the weights.
#
# **Predict** this weighted mean. (The plain mean was 101.)

# %% role="predict"
guess_weighted = None  # your guess: which gray level?

# %%
values = noisy_row[4:7]
differences = values - values[1]
weights = np.exp(-((differences / 50) ** 2) / 2)  # 1 for equal values
print("values ", values)
print("weights", weights.round(2))
weighted_mean = (values * weights).sum() / weights.sum()
compare_guess(guess_weighted, round(weighted_mean))

# %% [markdown]
# The 202 has a weight of 0.01, so the dark pixel stays dark.
#
# The four filters are in a dictionary: name → function. `lambda image: box_blur(image, 3)` is a short way to write a function that takes `image` and returns `box_blur(image, 3)`.

# %%
filters = {
    "box": lambda image: box_blur(image, 3),  # 3 × 3 pixels
    # the standard deviation of the kernel is 1.5 pixels
    "Gaussian": lambda image: gaussian_blur(image, 1.5),
    "median": lambda image: median_blur(image, 3),  # 3 × 3 pixels
    # similar: about 50 gray levels; near: about 2 pixels
    "bilateral": lambda image: bilateral_filter(image, 50, 2),
}
names = list(filters)
print(names)

# %% [markdown]
# **Predict** which of the four removes the *least* impulse noise.

# %% role="predict"
guess_impulse = None  # your guess: "box", "Gaussian", "median", "bilateral"?

# %%
scores = []
for name in names:
    filtered = filters[name](salted)
    scores.append(psnr(gray, filtered))
    print(f"{name:10} {scores[-1]:.1f} dB")
print(f"no filter  {psnr(gray, salted):.1f} dB")
compare_guess(guess_impulse, names[np.argmin(scores)])

# %%
results = [filters[name](salted) for name in names]
show(results, names, rows=(310, 410), cols=(600, 760), columns=2,
     text="noise_removal/impulse")

# %% [markdown]
# **Predict** which of the four is best against Gaussian noise.

# %% role="predict"
guess_gaussian = None  # your guess: "box", "Gaussian", "median", "bilateral"?

# %%
gaussian_scores = []
for name in names:
    filtered = filters[name](grainy)
    gaussian_scores.append(psnr(gray, filtered))
    print(f"{name:10} {gaussian_scores[-1]:.1f} dB")
print(f"no filter  {psnr(gray, grainy):.1f} dB")
compare_guess(guess_gaussian, names[np.argmax(gaussian_scores)])

# %%
results = [filters[name](grainy) for name in names]
show(results, names, rows=(310, 410), cols=(600, 760), columns=2,
     text="noise_removal/gaussian")

# %% [markdown]
# **Your turn, in words.** One camera has single black and white pixels, another one has grain everywhere. Which of the four filters do you choose for each, and why? And why does the bilateral filter fail at one of them? Write three or four sentences, and save the notebook (Ctrl+S) before you run the check.

# %% role="exercise"
exercise(
    "noise-choice",
    subject="written",
    title="Which filter for which noise?",
    points=3,
    rubric=(
        ("impulse noise: the median; an extreme value is sorted to an end, and never comes to the middle", 1),
        ("Gaussian noise: a weighted mean, Gaussian or bilateral; small errors of many pixels cancel", 1),
        ("bilateral against impulses: a white pixel differs from its neighbours, so it keeps its value", 1),
        ("names one filter as the best for every noise", -1),
    ),
)

# %% [markdown] role="answer"
# *Write your answer here (double-click), in place of this line.*

# %% [markdown] role="solution"
# Against single black and white pixels I choose the median: such a value is at an end of the sorted nine, never in their middle. It is better than the others by more than ten decibels. The bilateral filter removes the least: a white pixel is different from all its neighbours, so it keeps its value like the side of a step. Against grain I choose the Gaussian filter: a mean of many small errors is nearly 0, and it is the best of the four with these settings. With others, the bilateral filter can be better.

# %% role="check"
check("noise-choice")

# %% [markdown]
# There is no best filter for every noise. First look at the noise, then choose and measure.

# %%
# Check: the numbers in this section
assert round(weights[2], 2) == 0.01 and round(weighted_mean) < 60
assert sorted(scores)[-1] == scores[2] > sorted(scores)[-2] + 10 and min(scores) == scores[3]
assert max(gaussian_scores) == gaussian_scores[1]
assert psnr(gray, bilateral_filter(grainy, 80, 2)) > max(gaussian_scores)

# %% [markdown]
# ## 8 · Your turn: the median by hand ([[minutes]])
#
# *This is a good place for a break.*
#
# Write `median3(gray)`: each pixel becomes the median of its 3 × 3 neighbourhood. At the border use *replicate*: repeat the outermost rows and columns. Compute it yourself, with NumPy only, and do not change `gray`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: (height, width) uint8 | a new (height, width) uint8 array (the type counts) | `cleaned = median3(tiny)` |
#
# `np` is known in your cell. Import everything else that you use in this cell.

# %% role="exercise"
exercise(
    "noise-median",
    title="The 3 × 3 median",
    function="median3",
    exact_type=True,
    time_limit=10,
    hint="For each pixel, sort the nine values of its 3 × 3 neighbourhood and take the fifth of them.",
    border_hint="Only values at the border of the image are wrong. Repeat the outermost rows and columns before you take the neighbours: np.pad(gray, 1, mode='edge').",
    hints=(
        "Look at one pixel in the middle first. Which nine values are its neighbourhood, and which of them is the median when they are sorted? What is missing at a pixel in a corner?",
        "1. Pad the image by one pixel on each side, so that also a corner has nine neighbours.\n2. Make an empty array with the shape and the dtype of gray.\n3. Go over all rows and columns of gray. Cut the 3 × 3 window out of the padded image, sort its nine values, and store the fifth.",
        "Before the loops: padded = np.pad(gray, 1, mode='edge')\nInside the two loops over row and col:\n    window = padded[row : row + 3, col : col + 3]\n    result[row, col] = np.sort(window, axis=None)[?]\nWhich index has the fifth value?",
    ),
    explanation="Padding first means that the loop needs no special case: in the padded image every pixel of gray has nine neighbours. The pixel (row, col) of gray is at (row + 1, col + 1) in padded, so its window begins at (row, col). The results go into a new array. If they went into the array that is read, later pixels would see neighbours that are already changed.",
    another_way="You can also stack the nine shifted slices padded[row : row + height, col : col + width] in a list and take np.median(shifted, axis=0).astype(np.uint8): the same values without a loop over the pixels, and much faster on a camera frame.",
)

# %% role="answer"
def median3(gray):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 1, mode="edge")
    result = np.empty_like(gray)
    for row in range(height):
        for col in range(width):
            window = padded[row : row + 3, col : col + 3]
            result[row, col] = np.sort(window, axis=None)[4]
    return result


# %% role="check"
check("noise-median", median3)

# %% role="case" title="one wrong pixel" points=1
def inputs(rng):
    image = rng.integers(90, 110, size=(5, 6), dtype=np.uint8)
    image[rng.integers(1, 4), rng.integers(1, 5)] = 255
    return (image,)

# %% role="case" title="wrong pixels at the border" points=1
def inputs(rng):
    image = rng.integers(90, 200, size=(5, 5), dtype=np.uint8)
    image[0, rng.integers(0, 5)] = 255
    image[rng.integers(0, 5), 4] = 0
    return (image,)

# %% role="case" title="strong noise" points=0
def inputs(rng):
    image = rng.integers(0, 256, size=(7, 9), dtype=np.uint8)
    image[rng.random((7, 9)) < 0.2] = 255
    image[rng.random((7, 9)) < 0.2] = 0
    return (image,)

# %% role="hidden" title="a larger image" points=1 hint="Does your function work if height and width are very different?"
def inputs(rng):
    return (rng.integers(0, 256, size=(20, 33), dtype=np.uint8),)

# %% role="hidden" title="a single row" points=1 hint="What are the neighbours in an image with only one row?"
def inputs(rng):
    return (rng.integers(0, 256, size=(1, 12), dtype=np.uint8),)

# %% [markdown]
# ## 9 · Your turn: PSNR ([[minutes]], deeper)
#
# Write `my_psnr(clean, other)` with the formula of section 6. Remember what [[term:uint8]] does to a negative difference. For equal images the result is infinity, `float("inf")`. Use NumPy only.
#
# | Input | Output | Example call |
# |---|---|---|
# | `clean`, `other`: two (height, width) uint8 images of the same shape | one number, not rounded: the PSNR in decibel | `my_psnr(four_clean, four_noisy)` |

# %% role="exercise"
exercise(
    "noise-psnr",
    title="PSNR",
    function="my_psnr",
    time_limit=5,
    tolerance=1e-4,
    allowed=("scipy",),
    hint="Go through the formula step by step: widen, subtract, square, mean, 255**2 divided by this mean, logarithm to base 10, times 10.",
    hints=(
        "Compute the four pixels of section 6 on paper: 100 and 110, 100 and 90. What are the two differences, and what does uint8 make of 100 - 110?",
        "1. Convert both images to float.\n2. Subtract them, square each difference, and take the mean of all squares: the MSE.\n3. If the MSE is 0, return float(\"inf\").\n4. Otherwise put the MSE into the formula; np.log10 is the logarithm to base 10.",
        "difference = clean.astype(float) - other.astype(float)\nmse = np.mean(difference**2)\nThen an if for mse == 0. The last line returns 10 * np.log10(?), the formula with mse in it.",
    ),
    explanation="The images are converted to float before the subtraction, because a uint8 difference below 0 wraps around. The squares are averaged, so one number remains for the whole image. Equal images must be treated first: their MSE is 0, and 255**2 / 0 is not defined.",
    another_way="You can also write 20 * np.log10(255 / np.sqrt(mse)): the square root and the factor 20 belong together, as log10(x**2) is 2 * log10(x).",
)


def same_pixels_in_another_order(rng):
    clean = rng.integers(0, 256, size=(6, 6), dtype=np.uint8)
    clean[0, 0], clean[-1, -1] = 0, 255
    return clean, clean[::-1, ::-1].copy()


def one_pixel_differs(rng):
    clean = rng.integers(0, 255, size=(4, 5), dtype=np.uint8)
    other = clean.copy()
    other[rng.integers(0, 4), rng.integers(0, 5)] += 1
    return clean, other

# %% role="answer"
def my_psnr(clean, other):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def my_psnr(clean, other):
    difference = clean.astype(float) - other.astype(float)
    mse = np.mean(difference**2)
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(255**2 / mse))

# %% role="check"
check("noise-psnr", my_psnr)

# %% role="case" title="a brighter image" points=1
def inputs(rng):
    clean = rng.integers(0, 200, size=(4, 5), dtype=np.uint8)
    return clean, clean + rng.integers(1, 50, size=(4, 5), dtype=np.uint8)

# %% role="case" title="a darker image" points=1
def inputs(rng):
    clean = rng.integers(60, 256, size=(4, 5), dtype=np.uint8)
    return clean, clean - rng.integers(1, 60, size=(4, 5), dtype=np.uint8)

# %% role="case" title="the same pixels in another order" points=0 hint="Here some differences are larger than 200, and plus and minus cancel in their sum. Square each difference in float, then take the mean."
def inputs(rng):
    return same_pixels_in_another_order(rng)

# %% role="case" title="one pixel differs by 1" points=0 hint="Only equal images have an infinite PSNR: compare the MSE with 0."
def inputs(rng):
    return one_pixel_differs(rng)

# %% role="case" title="equal images" points=0 hint="For equal images the MSE is 0: return float(\"inf\") before you divide by it."
def inputs(rng):
    clean = rng.integers(0, 256, size=(4, 5), dtype=np.uint8)
    return clean, clean.copy()

# %% role="hidden" title="equal images, and images with very small or very large differences" points=1 hint="Return infinity if the mean squared error is 0, and only then. Compute the squares of large differences in float."
def inputs(rng):
    clean = rng.integers(0, 256, size=(6, 6), dtype=np.uint8)
    return [(clean, clean.copy()), one_pixel_differs(rng), same_pixels_in_another_order(rng)]


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
#
# **Next:** [[binarization]].

# %%
# Check: the numbers in the table
for image in (salted, grainy, *results):
    assert image.shape == (720, 1280) and image.dtype == np.uint8
assert 255**2 == 65_025 and isinstance(psnr(gray, salted), float)
