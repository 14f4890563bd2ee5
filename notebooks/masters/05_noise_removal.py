# ---
# jupyter:
#   imgproc_course:
#     title: Noise removal
#     minutes: 55
# ---

# %% [markdown]
# # 05 · Noise removal
#
# Every sensor makes mistakes. To see through them, a picture is compared with itself: a pixel with its neighbours. Whether that helps depends on *how* the neighbours are asked.
#
# **You will be able to**
# - tell two kinds of noise apart by looking at the numbers,
# - explain why a mean blurs edges and why a median does not,
# - compute a 3 × 3 median by hand,
# - measure with PSNR which of two filters cleaned better, and choose a filter by it.
#
# **Time** about 55 minutes. **You need** lesson 03.

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
# ## 1 · Noise is in every picture (5 minutes)
#
# **Ask.** A wall has one colour. Does the camera see one colour? Here are 8 × 8 pixels of the wall. **Predict**: all equal, or how far apart?

# %%
wall = gray[120:128, 880:888]
show(wall, "a piece of the wall", encoding="mono8",
     caption="One wall, one colour, and yet the numbers differ: this is the sensor's own noise.",
     alt="An eight by eight grid of nearly equal gray squares with their numbers.")
print("smallest", wall.min(), "  largest", wall.max(), "  standard deviation", round(float(wall.std()), 1), "gray levels")

assert 0 < wall.std() < 5

# %% [markdown]
# ## 2 · One row, one step (8 minutes)
#
# A picture is many rows, and one row is easier to read. Take a dark and a bright part with a step between them, and let the sensor err by a few gray levels.

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
# The flat parts got calmer, and we lost our edge: between 50 and 200 now stand 101 and 146, values that no pixel of the scene has.
#
# ## 3 · Planned failure: a mean against salt and pepper (6 minutes)
#
# A broken pixel does not err by a few gray levels: it is black or white. This is *salt and pepper* noise. **Predict** what the mean makes of one single white pixel among fifties.

# %%
salted_row = np.array([50, 50, 50, 50, 255, 50, 50, 50, 50])
print("salted", salted_row)
print("mean  ", mean_of_three(salted_row))

assert mean_of_three(salted_row).tolist() == [50, 50, 50, 118, 118, 118, 50, 50, 50]

# %% [markdown]
# One wrong pixel became three wrong pixels. **Repair it**: do not average, *vote*. Sort the three values and take the one in the middle: the **median**. An odd one out is never in the middle.

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
# ## 4 · Five by five (6 minutes)
#
# In a picture the neighbours stand on all sides: 3 × 3 = 9 values, and the median is the fifth of them when they are sorted. **Predict** the median around the white pixel in the middle.

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
     caption="The mean smears both wrong pixels over their neighbours; the median drops them and keeps the edge.",
     alt="Three grids of numbers: a white and a black pixel stand out in the first, and are gone in the third.")

assert cleaned[2, 2] == 53 and cleaned[1, 4] == 200

# %% [markdown]
# At the border three neighbours are missing. OpenCV's median repeats the outermost row and column (*replicate*), so that every pixel has nine.
#
# ## 5 · Four filters, two kinds of noise (8 minutes)
#
# Now on the robot's picture, with noise whose dice are *seeded*: everybody gets the same.

# %%
salted = add_salt_and_pepper(gray, 0.05, seed=1)
grainy = add_gaussian_noise(gray, 20, seed=1)
changed = (salted != gray).mean()
print(f"salt and pepper: {changed:.1%} of the pixels changed;  Gaussian: {(grainy != gray).mean():.1%}")

assert 0.04 < changed < 0.06

# %%
part = dict(rows=(310, 440), cols=(430, 740))
show([salted, grainy], ["salt and pepper", "Gaussian, 20 gray levels"], encoding="mono8", **part,
     caption="Left, few pixels are spoiled, but wholly; right, every pixel is spoiled a little.",
     alt="The ball and the marker twice: left with white and black specks, right with an even grain.")

# %% [markdown]
# **Predict** which filter wins on the left one, and which on the right.

# %%
filters = {
    "box 3": lambda picture: box_blur(picture, 3),
    "Gaussian 1.5": lambda picture: gaussian_blur(picture, 1.5),
    "median 3": lambda picture: median_blur(picture, 3),
    "bilateral": lambda picture: bilateral_filter(picture, 50, 2),
}
show([f(salted) for f in filters.values()], list(filters), encoding="mono8", **part, columns=2,
     caption="Salt and pepper, cleaned four times: only the median is rid of the specks.",
     alt="Ball and marker four times; specks are smeared in the first two and the fourth, and gone in the third.")

# %%
show([f(grainy) for f in filters.values()], list(filters), encoding="mono8", **part, columns=2,
     caption="Gaussian noise, cleaned four times: all calm it, and the bilateral filter keeps the marker sharp.",
     alt="Ball and marker four times, with less grain than before; the edges of the fourth are the sharpest.")

# %% [markdown]
# ## 6 · How clean is clean? (8 minutes)
#
# "Looks better" is no measure. **PSNR** (peak signal-to-noise ratio) is one: take the difference of each pixel to the clean picture, square it, take the mean (MSE), and set it against the largest value a pixel can have:
#
# $$\text{PSNR} = 10 \log_{10} \frac{255^2}{\text{MSE}} \quad\text{in decibel (dB); more is cleaner}$$
#
# By hand on four pixels:

# %%
a = np.array([[100, 100], [100, 100]], dtype=np.uint8)
b = np.array([[100, 110], [90, 100]], dtype=np.uint8)
squared = (a.astype(float) - b) ** 2
mse = squared.mean()
print("squared differences:", squared.ravel(), "  their mean:", mse)
print("PSNR:", round(10 * np.log10(255**2 / mse), 1), "dB")

assert mse == 50 and round(10 * np.log10(255**2 / mse), 1) == 31.1
assert psnr(a, b) == 10 * np.log10(255**2 / mse)

# %% [markdown]
# **Check** the guesses of section 5 with numbers. (SSIM, beside it, asks whether *structures* are kept; 1 is perfect.)

# %%
print(f"{'':14}{'salt and pepper':>22}{'Gaussian':>20}")
print(f"{'untouched':14}{psnr(gray, salted):>16.1f} dB {psnr(gray, grainy):>16.1f} dB")
score = {}
for name, f in filters.items():
    score[name] = psnr(gray, f(salted)), psnr(gray, f(grainy))
    alike = ssim(gray, f(salted)), ssim(gray, f(grainy))
    print(f"{name:14}{score[name][0]:>16.1f} dB {score[name][1]:>16.1f} dB   SSIM {alike[0]:.2f}, {alike[1]:.2f}")

assert max(score, key=lambda name: score[name][0]) == "median 3"
assert max(score, key=lambda name: score[name][1]) == "Gaussian 1.5"

# %% [markdown]
# No filter is best. The median wins against salt and pepper by more than ten decibels; against Gaussian noise a Gaussian does. First look at the noise, then choose.

# %%
others = max(score[name][0] for name in score if name != "median 3")
assert score["median 3"][0] - others > 10

# %% [markdown]
# Once on a photograph: an astronaut, a picture of NASA's in the public domain that comes with scikit-image.

# %%
from skimage import data

portrait = to_gray(data.astronaut()[..., ::-1])
spoiled = add_salt_and_pepper(portrait, 0.05, seed=2)
show([spoiled, median_blur(spoiled, 3)], ["salt and pepper", "3 × 3 median"], rows=(0, 300), cols=(100, 400),
     caption="The same filter on a photograph: specks gone, and eyelashes with them.",
     alt="The face of a smiling astronaut, with specks on the left and without on the right.")

assert psnr(portrait, median_blur(spoiled, 3)) > psnr(portrait, spoiled) + 10

# %% [markdown]
# ## 7 · Your turn: the median by hand (8 minutes)
#
# Write `median3(gray)`: each pixel of a (height, width) uint8 picture becomes the median of its 3 × 3 neighbourhood; at the border the outermost rows and columns are repeated. The result is a new (height, width) uint8 array.

# %% role="exercise"
exercise(
    "noise-median",
    title="The 3 × 3 median",
    function="median3",
    time_limit=10,
    refused=("cv2", "scipy", "skimage", "imgproc_course.imaging"),
    hint="Pad by one with np.pad(gray, 1, mode='edge'), stack the nine shifted pictures, and take np.median over the stack.",
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


# %% role="case" title="one wrong pixel" points=1 hint="The wrong pixel must be gone, and nothing else may change much."
def inputs(rng):
    picture = rng.integers(90, 110, size=(5, 6), dtype=np.uint8)
    picture[rng.integers(1, 4), rng.integers(1, 5)] = 255
    return (picture,)


# %% role="case" title="wrong pixels at the border" points=1 hint="At the border the outermost row and column are repeated, not filled with zeros."
def inputs(rng):
    picture = rng.integers(90, 200, size=(5, 5), dtype=np.uint8)
    picture[0, rng.integers(0, 5)] = 255
    picture[rng.integers(0, 5), 4] = 0
    return (picture,)


# %% role="hidden" title="a larger picture" points=1 hint="Does it work where height and width differ much?"
def inputs(rng):
    return (rng.integers(0, 256, size=(20, 33), dtype=np.uint8),)


# %% role="hidden" title="a single row" points=1 hint="What are the neighbours of a picture that has one row?"
def inputs(rng):
    return (rng.integers(0, 256, size=(1, 12), dtype=np.uint8),)


# %% role="mistake" name="a mean instead of a median" says="That is the mean of the nine. It smears a wrong pixel over its neighbours; the median is the fifth of the nine when they are sorted."
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 1, mode="edge")
    shifted = [padded[row : row + height, col : col + width] for row in range(3) for col in range(3)]
    return np.mean(shifted, axis=0).astype(np.uint8)


# %% role="mistake" name="a border of zeros" says="Beyond the border stand zeros, and they win votes there. Repeat the outermost rows and columns: np.pad(gray, 1, mode='edge')."
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 1)
    shifted = [padded[row : row + height, col : col + width] for row in range(3) for col in range(3)]
    return np.median(shifted, axis=0).astype(np.uint8)


# %% role="mistake" name="rows alone" says="Only neighbours in the same row were asked. A neighbourhood is three rows by three columns."
def median3(gray):
    width = gray.shape[1]
    padded = np.pad(gray, ((0, 0), (1, 1)), mode="edge")
    return np.median([padded[:, col : col + width] for col in range(3)], axis=0).astype(np.uint8)


# %% role="mistake" name="the border is left out" says="The result is smaller than the picture: the outermost pixels are missing. Pad before you look at neighbours."
def median3(gray):
    height, width = gray.shape
    shifted = [gray[row : row + height - 2, col : col + width - 2] for row in range(3) for col in range(3)]
    return np.median(shifted, axis=0).astype(np.uint8) if height > 2 else gray.copy()


# %% [markdown]
# ## 8 · Your turn: PSNR (5 minutes)
#
# Write `my_psnr(clean, other)`: two (height, width) uint8 pictures in, one float out, in decibel. Mind what `uint8` does to a difference. For equal pictures the answer is infinity, `float("inf")`.

# %% role="exercise"
exercise(
    "noise-psnr",
    title="PSNR",
    function="my_psnr",
    time_limit=5,
    refused=("cv2", "skimage", "imgproc_course.imaging"),
    hint="Widen both pictures to float before you subtract.",
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


# %% role="case" title="a brighter picture" points=1 tolerance=1e-6 hint="The differences are squared, then averaged."
def inputs(rng):
    clean = rng.integers(0, 200, size=(4, 5), dtype=np.uint8)
    return clean, clean + rng.integers(1, 50, size=(4, 5), dtype=np.uint8)


# %% role="case" title="a darker picture" points=1 tolerance=1e-6 hint="In uint8, 100 - 110 is 246: widen first."
def inputs(rng):
    clean = rng.integers(60, 256, size=(4, 5), dtype=np.uint8)
    return clean, clean - rng.integers(1, 60, size=(4, 5), dtype=np.uint8)


# %% role="hidden" title="equal pictures" points=1 hint="Dividing by zero is no answer; infinity is."
def inputs(rng):
    clean = rng.integers(0, 256, size=(6, 6), dtype=np.uint8)
    return clean, clean.copy()


# %% role="mistake" name="uint8 wraps" says="This is what uint8 wrap-around looks like: 100 - 110 gave 246. Widen to float before you subtract."
def my_psnr(clean, other):
    mse = np.mean(((clean - other).astype(float)) ** 2)
    return float("inf") if mse == 0 else float(10 * np.log10(255**2 / mse))


# %% role="mistake" name="the natural logarithm" says="np.log is the natural logarithm; decibel are counted with np.log10."
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    return float("inf") if mse == 0 else float(10 * np.log(255**2 / mse))


# %% role="mistake" name="the peak is not squared" says="The peak, 255, is squared as the differences are: 255**2 / MSE."
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    return float("inf") if mse == 0 else float(10 * np.log10(255 / mse))


# %% [markdown]
# ## 9 · Practice: choose a filter (5 minutes)
#
# Write `best_filter(clean, noisy, filters)`. `filters` is a dictionary of name → function; give back the *name* of the one whose result has the highest PSNR against `clean`. This one gives no marks, but it is what you will do when you meet a new camera.

# %% role="exercise"
exercise(
    "noise-choose",
    title="Choose a filter",
    function="best_filter",
    practice=True,
    time_limit=10,
    hint="Compute the PSNR of each filter's result, and remember the name that belongs to the largest.",
)

# %% role="answer"
def best_filter(clean, noisy, filters):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def best_filter(clean, noisy, filters):
    def distance(name):
        return np.mean((filters[name](noisy).astype(float) - clean) ** 2)

    return min(filters, key=distance)


# %% role="check"
check("noise-choose", best_filter)


# %% role="case" title="a spoiled picture"
def inputs(rng):
    clean = rng.integers(0, 200, size=(8, 8), dtype=np.uint8)
    noisy = clean + np.uint8(20)

    def darker_by_twenty(picture):
        return picture - np.uint8(20)

    def darker_by_ten(picture):
        return picture - np.uint8(10)

    return clean, noisy, {"darker by ten": darker_by_ten, "darker by twenty": darker_by_twenty}


# %% role="hidden" title="another spoiled picture" hint="The largest PSNR wins, wherever it stands in the dictionary."
def inputs(rng):
    clean = rng.integers(100, 200, size=(8, 8), dtype=np.uint8)
    noisy = clean - np.uint8(30)

    def brighter_by_thirty(picture):
        return picture + np.uint8(30)

    def brighter_by_ten(picture):
        return picture + np.uint8(10)

    return clean, noisy, {"brighter by thirty": brighter_by_thirty, "brighter by ten": brighter_by_ten}


# %% role="mistake" name="the worst instead of the best" says="That is the filter with the lowest PSNR: more decibel are better."
def best_filter(clean, noisy, filters):
    return max(filters, key=lambda name: np.mean((filters[name](noisy).astype(float) - clean) ** 2))


# %% [markdown]
# ## Recap
#
# A mean calms small errors and blurs edges; a median throws out the odd ones and keeps edges. Measure before you choose.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *gray* | (720, 1280) | uint8 | 0 to 255 | gray level |
# | noisy | (720, 1280) | uint8 | 0 to 255 | gray level |
# | filtered | (720, 1280) | uint8 | 0 to 255 | gray level |
# | MSE | one number | float64 | 0 to 65,025 | gray level squared |
# | PSNR | one number | float64 | 0 to infinity | decibel |

# %%
for picture in (salted, grainy, *[f(grainy) for f in filters.values()]):
    assert picture.shape == (720, 1280) and picture.dtype == np.uint8
assert 255**2 == 65_025 and isinstance(psnr(gray, salted), float)
