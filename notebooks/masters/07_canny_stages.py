# ---
# jupyter:
#   imgproc_course:
#     title: The stages of Canny
#     minutes: 90
# ---

# %% [markdown]
# # 07 · The stages of Canny
#
# `cv2.Canny(gray, 50, 150)` is one line, and for most people it stays a spell. Inside are five plain steps. You will write four of them, and at the end your edges equal OpenCV's on every pixel.
#
# **You will be able to**
# - say what each stage takes and gives, with its unit,
# - write Sobel, suppression, double threshold and hysteresis by hand,
# - say what 50 and 150 mean, and when to change them,
# - say why a noisy picture must be smoothed before its edges are looked for.
#
# **Time** about 90 minutes; a good place to pause is after section 5. **You need** lessons 03 and 05.

# %% role="given" exercise=["canny-sobel", "canny-suppression", "canny-thresholds", "canny-hysteresis"]
import numpy as np

# %% tags=["long"]
import cv2

from imgproc_course.display import draw, show, show_figure, tune
from imgproc_course.exercises import check
from imgproc_course.imaging import (
    add_gaussian_noise,
    canny,
    canny_stages,
    direction,
    gaussian_blur,
    gradient_angle,
    magnitude,
    sobel,
    to_gray,
)
from imgproc_course.recording import open_recording

recording = open_recording("drive")
gray = to_gray(recording.frame(30))
print("gray", gray.shape, gray.dtype, "range", gray.min(), "to", gray.max())

# %% [markdown]
# ## 1 · An edge is a jump (8 minutes)
#
# **Ask.** Where in this row is the edge? You see it at once: between the 50 and the 200. A program must compute it.
#
# **Predict.** For each pixel take its right neighbour minus its left neighbour. Where is the answer not zero?

# %%
row = np.array([50, 50, 50, 50, 200, 200, 200, 200])
padded = np.pad(row, 1, mode="edge")
difference = padded[2:] - padded[:-2]
print("row       ", row)
print("difference", difference)

assert difference.tolist() == [0, 0, 0, 150, 150, 0, 0, 0]

# %% [markdown]
# The weights `[-1, 0, 1]` answer 0 where nothing changes and the height of the jump where it does. A jump from bright to dark gives a negative answer.
#
# But one row is easily fooled by noise. **Sobel** asks three rows and gives the middle one double weight:
#
# $$\begin{bmatrix}-1&0&1\\-2&0&2\\-1&0&1\end{bmatrix}$$
#
# **Predict** the answer at a straight step of height 150: the weights 1, 2, 1 add up to 4.

# %%
step = np.tile(np.array([50, 50, 200, 200, 200], dtype=np.uint8), (5, 1))
grad_row, grad_col = sobel(step)
show([step, grad_col, grad_row], ["gray", "grad_col (along a row)", "grad_row (down a column)"],
     caption="Along the rows brightness jumps by 150: Sobel answers 4 × 150 = 600. Down the columns nothing changes.",
     alt="Three five by five grids: a step from 50 to 200; a grid with two columns of 600; a grid of zeros.")

assert grad_col.max() == 600 == 4 * 150 and not grad_row.any()

# %% [markdown]
# Remember that **4**: a threshold of 50 for Canny means a straight step of 12.5 gray levels, and 150 one of 37.5. The unit of every threshold below is the *Sobel answer*, not the gray level.

# %%
assert 50 / 4 == 12.5 and 150 / 4 == 37.5

# %% [markdown]
# ## 2 · Your turn: Sobel (12 minutes)
#
# Write `my_sobel(gray)`: a (height, width) uint8 picture in, two (height, width) int32 arrays out, `grad_row, grad_col`, in this order. `grad_row` uses the transposed weights: the row below minus the row above. At the border the outermost row and column are repeated.

# %% role="exercise"
exercise(
    "canny-sobel",
    title="Sobel",
    function="my_sobel",
    time_limit=5,
    refused=("cv2", "scipy", "skimage", "imgproc_course.imaging"),
    hint="Widen to int32, pad by one with mode='edge', then add six shifted pictures with their weights.",
)

# %% role="answer"
def my_sobel(gray):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    up, middle, down = p[:-2], p[1:-1], p[2:]
    grad_col = (up + 2 * middle + down)[:, 2:] - (up + 2 * middle + down)[:, :-2]
    across = p[:, :-2] + 2 * p[:, 1:-1] + p[:, 2:]
    grad_row = across[2:] - across[:-2]
    return grad_row, grad_col


# %% role="check"
check("canny-sobel", my_sobel)


# %% role="case" title="an upright step" points=1 hint="Which of the two sees a jump along a row?"
def inputs(rng):
    low, high = rng.integers(0, 100), rng.integers(120, 256)
    picture = np.full((5, 6), low, dtype=np.uint8)
    picture[:, rng.integers(2, 5) :] = high
    return (picture,)


# %% role="case" title="a lying step, bright above dark" points=1 hint="From bright to dark the answer is negative: widen before you subtract."
def inputs(rng):
    picture = np.full((6, 5), rng.integers(150, 256), dtype=np.uint8)
    picture[rng.integers(2, 5) :] = rng.integers(0, 80)
    return (picture,)


# %% role="case" title="something at the border" points=1 hint="Look at the border: are the outermost pixels repeated?"
def inputs(rng):
    return (rng.integers(0, 256, size=(4, 5), dtype=np.uint8),)


# %% role="hidden" title="any picture" points=1 hint="Look at the border: are the outermost pixels repeated?"
def inputs(rng):
    return (rng.integers(0, 256, size=(7, 9), dtype=np.uint8),)


# %% role="mistake" name="uint8 wraps" says="This is what uint8 wrap-around looks like: dark minus bright ran below 0 and began again at 255. Widen to int32 before you subtract."
def my_sobel(gray):
    p = np.pad(gray, 1, mode="edge")
    along = p[:-2] + 2 * p[1:-1] + p[2:]
    across = p[:, :-2] + 2 * p[:, 1:-1] + p[:, 2:]
    return (across[2:] - across[:-2]).astype(np.int32), (along[:, 2:] - along[:, :-2]).astype(np.int32)


# %% role="mistake" name="rows and columns exchanged" says="The two answers have changed places: grad_row, the change down a column, comes first."
def my_sobel(gray):
    grad_row, grad_col = solution(gray)
    return grad_col, grad_row


# %% role="mistake" name="the sign is turned" says="The sign is turned around: right minus left, and below minus above."
def my_sobel(gray):
    grad_row, grad_col = solution(gray)
    return -grad_row, -grad_col


# %% role="mistake" name="a border of zeros" says="Beyond the border stand zeros, and every border became an edge. Repeat the outermost rows and columns: np.pad(..., mode='edge')."
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1)
    along = p[:-2] + 2 * p[1:-1] + p[2:]
    across = p[:, :-2] + 2 * p[:, 1:-1] + p[:, 2:]
    return across[2:] - across[:-2], along[:, 2:] - along[:, :-2]


# %% role="mistake" name="the middle not doubled" says="All three rows have the same weight here (that is Prewitt's filter). Sobel gives the middle one double weight."
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    along = p[:-2] + p[1:-1] + p[2:]
    across = p[:, :-2] + p[:, 1:-1] + p[:, 2:]
    return across[2:] - across[:-2], along[:, 2:] - along[:, :-2]


# %% [markdown]
# ## 3 · How strong, and which way (8 minutes)
#
# Two answers a pixel make an arrow: `grad_col` to the right, `grad_row` down. It points from dark to bright, across the edge. Its length is the **magnitude**. OpenCV's plain form adds the two without their signs, |grad_row| + |grad_col|: this is the *L1 norm*.

# %%
slanted = np.array([[40, 40, 40, 60, 160],
                    [40, 40, 50, 140, 200],
                    [40, 45, 120, 200, 200],
                    [45, 100, 195, 200, 200],
                    [90, 180, 200, 200, 200]], dtype=np.uint8)
down, right = sobel(slanted)
figure, axes = draw(slanted, "gradient of the middle pixel", encoding="mono8")
axes[0].annotate("", xy=(2 + right[2, 2] / 400, 2 + down[2, 2] / 400), xytext=(2, 2),
                 arrowprops={"color": "tab:orange", "width": 3, "headwidth": 12})
show_figure(figure, alt="A grid with a slanted edge; an orange arrow points from its middle to the lower right.",
            caption="The arrow points from dark to bright, straight across the edge.")
print("grad_row", down[2, 2], " grad_col", right[2, 2], " magnitude", abs(down[2, 2]) + abs(right[2, 2]))

# %%
size = magnitude(down, right)
assert size[2, 2] == abs(int(down[2, 2])) + abs(int(right[2, 2]))

# %% [markdown]
# The same on the robot's picture. Where the arrow points is shown as a colour (a *hue*), how long it is as brightness:

# %%
stages = canny_stages(gray, 50, 150)
size = stages.magnitude
print("magnitude", size.shape, size.dtype, "range", size.min(), "to", size.max())
show(np.minimum(stages.magnitude, 500), "magnitude (L1), up to 500",
     caption="The stronger the jump, the brighter: outlines come out, broad and of different strength.",
     alt="The living room as bright outlines on black: books, door, chair, rug and ball.")

# %%
angle = gradient_angle(stages.grad_row, stages.grad_col) % 360  # degrees
hsv = np.zeros((*gray.shape, 3), np.uint8)
hsv[..., 0] = angle / 2  # OpenCV counts hue in steps of two degrees
hsv[..., 1] = 255
hsv[..., 2] = np.minimum(stages.magnitude // 2, 255)
show(cv2.cvtColor(hsv, cv2.COLOR_HSV2BGR), "direction as hue", rows=(310, 440), cols=(430, 740),
     caption="Around the ball the gradient turns through all directions, so its rim runs through all hues.",
     alt="The rim of the ball as a ring in all colours of the rainbow, beside the coloured outlines of the marker.")

# %% [markdown]
# ## 4 · Only the ridge counts (10 minutes)
#
# An edge should be one pixel thin. But a jump that is spread over a few pixels answers over a few pixels. **Predict** from these numbers which pixel *is* the edge.

# %%
soft = np.array([50, 50, 60, 90, 150, 190, 200, 200], dtype=np.uint8)
_, across = sobel(np.tile(soft, (3, 1)))
profile = np.abs(across[1])
print("gray     ", soft)
print("magnitude", profile)

assert profile.tolist() == [0, 40, 160, 360, 400, 200, 40, 0]

# %% [markdown]
# The largest, of course: 400. So each pixel is compared with its two neighbours *along its gradient*, and survives only as a maximum. This is **non-maximum suppression**. In a picture the gradient may point anywhere, and a pixel has eight neighbours; so the direction is put into one of four *sectors*:
#
# | sector | the gradient points | first neighbour | second neighbour |
# |---|---|---|---|
# | 0 | along the row | left | right |
# | 1 | down-right or up-left | above left | below right |
# | 2 | down the column | above | below |
# | 3 | down-left or up-right | above right | below left |
#
# Two equal neighbours must not both survive, nor both vanish. OpenCV's rule: in sectors 0 and 2 a pixel survives if it is *greater* than the first neighbour and *at least as great* as the second; in sectors 1 and 3 it must be greater than both. Beyond the border the magnitude counts as 0.

# %%
sector = direction(stages.grad_row, stages.grad_col)
print("pixels in sector 0, 1, 2, 3:", np.bincount(sector.ravel()))

assert (sector == stages.direction).all()

# %% [markdown]
# Where is the border between two sectors? Halfway between 0° and 45°, at 22.5°. OpenCV asks without any angle: is |grad_row| smaller than |grad_col| times 13573 / 2¹⁵? That fraction is the tangent of 22.5°, in whole numbers.

# %%
print("13573 / 2**15 =", round(13573 / 2**15, 4), "  tangent of 22.5 degrees =", round(float(np.tan(np.pi / 8)), 4))

assert round(13573 / 2**15, 4) == round(float(np.tan(np.pi / 8)), 4) == 0.4142

# %%
zoom = dict(rows=(376, 400), cols=(440, 464))
pair = [np.minimum(stages.magnitude, 500), np.minimum(stages.thinned, 500)]
show(pair, ["magnitude", "after suppression"], **zoom, numbers=False,
     caption="The rim of the ball, enlarged: a broad ridge before, one pixel after.",
     alt="Two enlarged patches: left a broad bright band, right a thin line of single pixels.")

# %% [markdown]
# ## 5 · Your turn: suppression (15 minutes)
#
# Write `suppress(magnitude, sector)`: two (height, width) arrays in, int32 and uint8; out a new int32 array in which every pixel that survives keeps its magnitude and every other is 0. The rule and the table stand above.

# %% role="exercise"
exercise(
    "canny-suppression",
    title="Non-maximum suppression",
    function="suppress",
    time_limit=10,
    refused=("cv2", "scipy", "skimage", "imgproc_course.imaging"),
    hint="Pad the magnitude with zeros. Two plain loops over rows and columns are fine; look up the two neighbours by sector.",
)


# %% role="answer"
def suppress(magnitude, sector):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def suppress(magnitude, sector):
    height, width = magnitude.shape
    padded = np.pad(magnitude, 1)
    first = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    thinned = np.zeros_like(magnitude)
    for row in range(height):
        for col in range(width):
            d_row, d_col = first[int(sector[row, col])]
            here = magnitude[row, col]
            one = padded[1 + row + d_row, 1 + col + d_col]
            two = padded[1 + row - d_row, 1 + col - d_col]
            beats_two = here >= two if sector[row, col] in (0, 2) else here > two
            if here > one and beats_two:
                thinned[row, col] = here
    return thinned


# %% role="check"
check("canny-suppression", suppress)


# %% role="case" title="an upright ridge" points=1 hint="Sector 0 compares with left and right."
def inputs(rng):
    magnitude = np.sort(rng.integers(1, 400, size=(5, 7)), axis=1)[:, [0, 2, 4, 6, 5, 3, 1]].astype(np.int32)
    return magnitude, np.zeros((5, 7), dtype=np.uint8)


# %% role="case" title="equal neighbours" points=1 hint="Greater than the first, at least as great as the second: then one of two equals survives."
def inputs(rng):
    magnitude = np.zeros((6, 5), dtype=np.int32)
    row = rng.integers(1, 4)
    magnitude[row : row + 2] = rng.integers(100, 400)
    return magnitude, np.full((6, 5), 2, dtype=np.uint8)


# %% role="case" title="all four sectors" points=1 hint="Which neighbours belong to sectors 1 and 3? Draw them."
def inputs(rng):
    return rng.integers(0, 400, size=(7, 8)).astype(np.int32), rng.integers(0, 4, size=(7, 8), dtype=np.uint8)


# %% role="hidden" title="few values, many equals" points=1 hint="In sectors 1 and 3 a pixel must be greater than both neighbours."
def inputs(rng):
    return rng.integers(0, 4, size=(12, 15)).astype(np.int32), rng.integers(0, 4, size=(12, 15), dtype=np.uint8)


# %% role="mistake" name=">= for >" says="Two equal neighbours both survived, and the edge is two pixels thick: towards the first neighbour it must be greater, not just as great."
def suppress(magnitude, sector):
    padded = np.pad(magnitude, 1)
    first = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    thinned = np.zeros_like(magnitude)
    for (row, col), here in np.ndenumerate(magnitude):
        d_row, d_col = first[int(sector[row, col])]
        if here >= padded[1 + row + d_row, 1 + col + d_col] and here >= padded[1 + row - d_row, 1 + col - d_col]:
            thinned[row, col] = here
    return thinned


# %% role="mistake" name="> on both sides" says="Of two equal neighbours neither survived, and the edge has a hole: in sectors 0 and 2 'at least as great' is enough towards the second neighbour."
def suppress(magnitude, sector):
    padded = np.pad(magnitude, 1)
    first = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    thinned = np.zeros_like(magnitude)
    for (row, col), here in np.ndenumerate(magnitude):
        d_row, d_col = first[int(sector[row, col])]
        if here > padded[1 + row + d_row, 1 + col + d_col] and here > padded[1 + row - d_row, 1 + col - d_col]:
            thinned[row, col] = here
    return thinned


# %% role="mistake" name="along the edge instead of across it" says="Each pixel was compared along the edge, not across it: sector 0 means that the gradient points along the row, so its neighbours are left and right."
def suppress(magnitude, sector):
    return solution(magnitude, ((sector + 2) % 4).astype(np.uint8))


# %% role="mistake" name="all eight neighbours" says="Each pixel was compared with all eight neighbours. Only the two along its gradient count, or edges break where their strength changes."
def suppress(magnitude, sector):
    padded = np.pad(magnitude, 1)
    thinned = np.zeros_like(magnitude)
    for (row, col), here in np.ndenumerate(magnitude):
        around = padded[row : row + 3, col : col + 3].copy()
        around[1, 1] = 0
        if here > around.max():
            thinned[row, col] = here
    return thinned


# %% role="mistake" name="the diagonals exchanged" says="Sectors 1 and 3 have changed places: 1 compares with above left and below right, 3 with above right and below left."
def suppress(magnitude, sector):
    return solution(magnitude, np.where(sector % 2 == 1, 4 - sector, sector).astype(np.uint8))


# %% [markdown]
# ## 6 · Two thresholds (5 minutes)
#
# Which ridges are edges? One threshold is a bad judge: set it low and the floor's grain comes in, set it high and outlines break. Canny uses two. Above `high` a pixel is an edge for certain: a *seed*. Above `low` it is a *candidate*. Below, it is nothing.

# %%
seeds = stages.thinned > 150
candidates = stages.thinned > 50
print(f"candidates {candidates.sum():,}   seeds {seeds.sum():,}")
show([candidates, seeds], ["candidates: above 50", "seeds: above 150"],
     caption="Low brings everything, the floor's boards with it; high brings only the strongest pieces.",
     alt="Left, many thin lines all over the room; right, fewer and broken lines.")

assert (stages.seeds == seeds).all() and (stages.candidates == candidates).all()
assert not (seeds & ~candidates).any()

# %% [markdown]
# ## 7 · Your turn: the double threshold (4 minutes)
#
# Write `double_threshold(thinned, low, high)`: an int32 array and two numbers in, two bool arrays out, `candidates, seeds`: strictly above `low`, strictly above `high`.

# %% role="exercise"
exercise(
    "canny-thresholds",
    title="The double threshold",
    function="double_threshold",
    time_limit=5,
    refused=("cv2", "skimage", "imgproc_course.imaging"),
    hint="A comparison of an array with a number gives a bool array.",
)


# %% role="answer"
def double_threshold(thinned, low, high):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def double_threshold(thinned, low, high):
    return thinned > low, thinned > high


# %% role="check"
check("canny-thresholds", double_threshold)


# %% role="case" title="values on the line" points=1 hint="Above means strictly above: a value equal to low is no candidate."
def inputs(rng):
    low, high = int(rng.integers(20, 80)), int(rng.integers(100, 200))
    values = np.array([0, low - 1, low, low + 1, high - 1, high, high + 1, 400, 5], np.int32)
    return rng.permutation(values).reshape(3, 3), low, high


# %% role="hidden" title="any magnitudes" points=1 hint="Every seed is a candidate too."
def inputs(rng):
    return rng.integers(0, 300, size=(8, 9)).astype(np.int32), 60, 180


# %% role="mistake" name=">= for >" says="A value equal to a threshold is not above it: use >, as OpenCV does."
def double_threshold(thinned, low, high):
    return thinned >= low, thinned >= high


# %% role="mistake" name="seeds and candidates exchanged" says="Candidates come first: there are more of them, since low is the smaller threshold."
def double_threshold(thinned, low, high):
    return thinned > high, thinned > low


# %% role="mistake" name="candidates without the seeds" says="Your candidates lack the seeds. Every pixel above low is a candidate, however strong it is."
def double_threshold(thinned, low, high):
    return (thinned > low) & (thinned <= high), thinned > high


# %% [markdown]
# ## 8 · Hysteresis: a seed pulls its line along (8 minutes)
#
# A candidate becomes an edge if it touches an edge: at any of its eight sides and corners. So edges grow from the seeds, step by step, along the candidates, until nothing is left to take. **Predict**: which of the letters become edges? (S is a seed, c a candidate.)
#
# ```
# S c c . . c
# . . . c . c
# c . . . . .
# ```

# %%
def grow_once(edges, candidates):
    padded = np.pad(edges, 1)
    height, width = edges.shape
    near = [padded[row : row + height, col : col + width] for row in range(3) for col in range(3)]
    return candidates & np.any(near, axis=0)


# %%
def grown(candidates, seeds, steps):
    edges = seeds
    for _ in range(steps):
        edges = grow_once(edges, candidates)
    return edges


letters = np.array([list("Scc..c"), list("...c.c"), list("c.....")])
chain = grown(letters != ".", letters == "S", 10)
print(np.where(chain, "E", letters))

assert chain.astype(int).tolist() == [[1, 1, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 0, 0]]

# %% [markdown]
# On the robot's picture, with a slider for the number of steps: pull it and watch the lines grow out of the seeds.

# %% tags=["nbval-ignore-output"]
def growth(frame, steps=0):
    edges = grown(stages.candidates, stages.seeds, steps)
    return np.where(edges, 255, 0).astype(np.uint8)


growing = tune(growth, gray, steps=(0, 60), caption="Edges after so many steps of growth.",
               alt="White lines on black, longer with each step.")

# %%
early, late = grown(stages.candidates, stages.seeds, 3), grown(stages.candidates, stages.seeds, 400)
print(f"seeds {stages.seeds.sum():,}   after 3 steps {early.sum():,}   after 400 {late.sum():,}")
show([stages.seeds, late], ["seeds", "after growth"],
     caption="Broken pieces have joined to outlines; most of the floor's grain touches no seed and is gone.",
     alt="Left, broken lines; right, the same lines joined to closed outlines.")

assert ((stages.edges == 255) == late).all()

# %% [markdown]
# ## 9 · Your turn: hysteresis (10 minutes)
#
# Write `grow(candidates, seeds)`: two bool arrays in, one uint8 array out: 255 where an edge is, 0 elsewhere. A candidate is an edge if a chain of candidates, touching at sides or corners, leads from it to a seed.

# %% role="exercise"
exercise(
    "canny-hysteresis",
    title="Hysteresis",
    function="grow",
    time_limit=10,
    refused=("cv2", "scipy", "skimage", "imgproc_course.imaging"),
    hint="Grow by one step until the number of edge pixels stops changing.",
)


# %% role="answer"
def grow(candidates, seeds):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def grow(candidates, seeds):
    height, width = candidates.shape
    edges = seeds & candidates
    while True:
        padded = np.pad(edges, 1)
        near = [padded[row : row + height, col : col + width] for row in range(3) for col in range(3)]
        larger = candidates & np.any(near, axis=0)
        if larger.sum() == edges.sum():
            return np.where(edges, 255, 0).astype(np.uint8)
        edges = larger


# %% role="check"
check("canny-hysteresis", grow)


# %% role="case" title="a chain that turns corners" points=1 hint="Corners touch too: each pixel has eight neighbours."
def inputs(rng):
    candidates = np.eye(8, dtype=bool)
    candidates[rng.integers(4, 7), :] = True
    candidates[0, 6:] = True  # an island
    seeds = np.zeros_like(candidates)
    seeds[0, 0] = True
    return candidates, seeds


# %% role="case" title="a long snake" points=1 hint="One step of growth is not enough: go on until nothing changes."
def inputs(rng):
    candidates = np.zeros((9, 9), dtype=bool)
    candidates[0::2] = True
    for row in range(1, 9, 2):
        candidates[row, 0 if row % 4 == 3 else 8] = True
    seeds = np.zeros_like(candidates)
    seeds[0, rng.integers(0, 3)] = True
    return candidates, seeds


# %% role="case" title="an island at each border" points=1 hint="The picture's left border does not touch its right one, nor its top the bottom."
def inputs(rng):
    candidates = np.zeros((7, 9), dtype=bool)
    candidates[3, : rng.integers(3, 5)] = True
    candidates[3, 6:] = True  # at the other end of the seed's row
    candidates[0, 2:5] = True
    candidates[6, 2:5] = True
    candidates[5, 7] = True  # touches nothing, not even across the border
    seeds = np.zeros_like(candidates)
    seeds[3, 0] = seeds[0, 3] = True
    return candidates, seeds


# %% role="hidden" title="islands" points=1 hint="An island of candidates without a seed is no edge."
def inputs(rng):
    candidates = rng.random((24, 30)) < 0.4
    return candidates, candidates & (rng.random((24, 30)) < 0.05)


# %% role="mistake" name="four neighbours only" says="Only sides were asked, not corners: a slanted line breaks. Each pixel has eight neighbours."
def grow(candidates, seeds):
    edges = seeds & candidates
    while True:
        p = np.pad(edges, 1)
        larger = candidates & (edges | p[:-2, 1:-1] | p[2:, 1:-1] | p[1:-1, :-2] | p[1:-1, 2:])
        if larger.sum() == edges.sum():
            return np.where(edges, 255, 0).astype(np.uint8)
        edges = larger


# %% role="mistake" name="np.roll across the border" says="Edges jumped across the picture's border: np.roll pushes a row out at one end and in again at the other, so that the left border touches the right one. Pad with False and take shifted parts instead."
def grow(candidates, seeds):
    edges = seeds & candidates
    while True:
        steps = [(row, col) for row in (-1, 0, 1) for col in (-1, 0, 1)]
        near = np.any([np.roll(edges, step, axis=(0, 1)) for step in steps], axis=0)
        larger = candidates & near
        if larger.sum() == edges.sum():
            return np.where(edges, 255, 0).astype(np.uint8)
        edges = larger


# %% role="mistake" name="one step only" says="The edges grew by one step and stopped. Go on until nothing changes any more."
def grow(candidates, seeds):
    height, width = candidates.shape
    padded = np.pad(seeds, 1)
    near = [padded[row : row + height, col : col + width] for row in range(3) for col in range(3)]
    return np.where(candidates & np.any(near, axis=0), 255, 0).astype(np.uint8)


# %% role="mistake" name="the seeds alone" says="Only the seeds came back: let them grow along the candidates that touch them."
def grow(candidates, seeds):
    return np.where(seeds & candidates, 255, 0).astype(np.uint8)


# %% role="mistake" name="all candidates" says="All candidates became edges. Only those count that a chain of candidates joins to a seed."
def grow(candidates, seeds):
    return np.where(candidates, 255, 0).astype(np.uint8)


# %% role="mistake" name="bool instead of 0 and 255" says="The edges are right, but as True and False: the task asks for uint8, 0 and 255."
def grow(candidates, seeds):
    return solution(candidates, seeds) == 255


# %% [markdown]
# ## 10 · Does OpenCV agree? (4 minutes)
#
# All stages in a row are `canny_stages`; the package's `canny` gives the same, only faster. **Check** against OpenCV on ten pictures of the drive, pixel by pixel.

# %%
different = 0
for k in range(0, 90, 9):
    picture = to_gray(recording.frame(k))
    different += int((canny(picture, 50, 150) != cv2.Canny(picture, 50, 150)).sum())
print("pixels that differ from OpenCV:", different, "of", 10 * gray.size)

assert different == 0
assert (canny(gray, 50, 150) == stages.edges).all()

# %% [markdown]
# ## 11 · Planned failure: Canny on a noisy frame (6 minutes)
#
# What is sold as Canny starts with a Gaussian blur. `cv2.Canny` does **not** blur: that is left to you. **Predict** what a little noise, 15 gray levels, does to the edges.

# %%
noisy = add_gaussian_noise(gray, 15, seed=1)
unblurred = canny(noisy, 50, 150)
show([canny(gray, 50, 150), unblurred], ["edges of the frame", "edges with noise of 15 gray levels"],
     caption="The noise is faint to the eye, and the edges drown in it: every grain is a jump.",
     alt="Left, clear outlines of the room; right, white speckle nearly all over.")
print(f"edge pixels: {(canny(gray, 50, 150) > 0).mean():.1%} before, {(unblurred > 0).mean():.1%} with noise")

assert (unblurred > 0).sum() > 3 * (canny(gray, 50, 150) > 0).sum()

# %% [markdown]
# **Repair it**: blur first. `sigma` says how far, in pixels. The jump of an outline survives; the jumps of single grains do not.

# %%
repaired = canny(noisy, 50, 150, sigma=2)
show([unblurred, repaired], ["without blur", "sigma = 2 pixels"], encoding="mono8",
     caption="After a blur of two pixels the outlines are back.",
     alt="Left, speckle; right, clean outlines of the room.")

assert (repaired > 0).sum() < (unblurred > 0).sum() / 3
assert (repaired == canny(gaussian_blur(noisy, 2), 50, 150)).all()

# %% [markdown]
# ## 12 · Turn the knobs (8 minutes)
#
# Three numbers decide: `low`, `high` and `sigma`. Move them. Look for a setting that keeps the outlines of ball, chair and marker, and loses the floor's grain. The line below the sliders is code that you can copy.

# %% tags=["nbval-ignore-output"]
tuner = tune(canny, gray, thresholds=(0, 1020), sigma=(0, 5.0), caption="Edges of the robot's picture.",
             alt="White lines on black, as the sliders leave them.")

# %% [markdown]
# Once on a photograph: a cat, a picture that comes with scikit-image (CC0).

# %%
from skimage import data

cat = to_gray(data.chelsea()[..., ::-1])
show([cat, canny(cat, 50, 150), canny(cat, 50, 150, sigma=2)], ["photograph", "sigma = 0", "sigma = 2"],
     caption="Fur is all edges until it is blurred: what counts as an edge depends on the scale you look at.",
     alt="A cat's face; its edges with all the hairs; its edges after a blur, with eyes, nose and ears only.")

assert (canny(cat, 50, 150) == cv2.Canny(cat, 50, 150)).all()

# %% [markdown]
# ## Recap
#
# Canny asks five things: how strong is the jump, which way does it point, is it the ridge, is it strong, and does it touch something strong. `cv2.Canny` leaves the blur to you.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *gray* | (720, 1280) | uint8 | 0 to 255 | gray level |
# | grad_row, grad_col | (720, 1280) | int32 | −1020 to 1020 | Sobel answer (a straight step of h gives 4 h) |
# | magnitude (L1) | (720, 1280) | int32 | 0 to 1530 | Sobel answer |
# | thinned | (720, 1280) | int32 | 0 to 1530 | Sobel answer |
# | candidates, seeds | (720, 1280) | bool | False, True | yes or no |
# | edges | (720, 1280) | uint8 | 0 and 255 | no and yes |

# %%
strongest = np.array([[0, 0, 0], [0, 0, 255], [0, 255, 255]], np.uint8)  # no neighbourhood answers more
assert 4 * 255 == 1020 and magnitude(*sobel(strongest))[1, 1] == 6 * 255 == 1530
for field in ("grad_row", "grad_col", "magnitude", "thinned", "candidates", "seeds", "edges"):
    stage = getattr(stages, field)
    print(f"{field:10} {stage.shape!s:12} {stage.dtype}")
    assert stage.shape == (720, 1280)
