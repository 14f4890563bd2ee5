# ---
# jupyter:
#   imgproc_course:
#     title: Numbers with doubt
# ---

# %% [markdown]
# # Numbers with doubt
#
# A robot measures, and every measured number is a little wrong. So it needs two things: the number, and how far it may be wrong. In this lesson you compute with both. The next three lessons use all of it: to track a ball, to find the robot's place, and to draw a map.
#
# **You will be able to**
# - compute the mean, the variance and the covariance of many measurements,
# - multiply matrices by hand, and use the inverse of a matrix,
# - say how the doubt grows when the robot drives on,
# - find the line that fits many points best, with a weight for each point,
# - find an unknown number from its errors, step by step (Gauss-Newton),
# - take a matrix apart (SVD), and find the rotation that is nearest to it.
#
# **Time** [[minutes]], with a pause after section 4. **You need** [[drive_the_robot]] and [[obstacles_ahead]]. Matrices are explained here. You do not need ROS 2.

# %% role="given" exercise=["doubt-covariance", "doubt-line", "doubt-step", "doubt-rotation"]
import math

import numpy as np

# %%
from matplotlib.figure import Figure

from imgproc_course.display import show_figure
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.simulation import Simulation

# %% role="texts"
figure_texts = {
    "readings": (
        "100 readings of one ray of the laser scanner. The robot stands still; the gray band is one standard deviation on each side of the mean.",
        "Dots scattered around a horizontal gray band, most of them inside it.",
    ),
    "robots": (
        "How far the odometry of each of 200 robots is from the mean, in y and in yaw. On the black ellipse the squared distance is 9.21; the robots outside of it are red.",
        "A long thin cloud of dots from the lower left to the upper right, with an ellipse around it. A few red dots lie just outside of the ellipse.",
    ),
    "wall": (
        "The robot at (0, 0) looks along x. Twelve rays to its left end on the wall, and the fitted line passes through them.",
        "Twelve dots on a straight line that falls a little from left to right, far above a triangle which shows the robot.",
    ),
    "valley": (
        "The sum of squares for each place, and the parabola of the first step. The step goes to the lowest point of the parabola, not yet of the curve.",
        "A gray curve with two valleys. A blue parabola touches it at a dot on the slope; its lowest point lies near the left valley.",
    ),
    "svd": (
        "What the matrix F does with a circle: V rotates it, s makes it longer in one direction and shorter in the other, U rotates it again. The red and the blue point are always the same two points.",
        "Four panels: a circle; the circle with its two points rotated; an ellipse along the axes; the same ellipse, rotated.",
    ),
}

# %% [markdown]
# ## 1 · One number ([[minutes]])
#
# The robot stands still in front of a wall, and its laser scanner measures the distance straight ahead, 100 times:

# %%
robot = Simulation(seed=1, start=(0.45, -1.0, 0.0), movers=False)
readings = np.zeros(100)
for k in range(100):
    readings[k] = robot.scan().ranges[0]
    robot.step(0, 0, dt=0.1)
print(readings[:6].round(3), "m")

# %% [markdown]
# Which number is right? None. But together they tell more than each alone. By hand, with four numbers: first their *mean*, then how far each is from the mean (its *deviation*), then the mean of the **squared** deviations. This is the *[[term:variance]]*.

# %%
few = np.array([5.0, 5.2, 4.9, 5.3])
mean = few.sum() / 4
deviations = few - mean
variance = (deviations**2).sum() / 4
print("mean", mean.round(3), "  deviations", deviations.round(3))
print("variance", variance.round(4), "  standard deviation", round(math.sqrt(variance), 3))

# %% [markdown]
# Why squared? The deviations themselves always add up to 0. Squares are never negative, and large deviations count more. The unit of the variance is m². So people often say its root, the [[term:standard deviation]] σ, here 0.158 m: the typical error of **one** reading. NumPy has both: `few.var()` and `few.std()`.

# %%
mean, deviation = readings.mean().round(4), readings.std().round(4)
print("mean", mean, "m   standard deviation", deviation, "m")
figure = Figure(figsize=(7, 2.4), layout="constrained")
axes = figure.subplots()
axes.plot(readings.round(4), ".")
axes.axhspan(mean - deviation, mean + deviation, color="0.5", alpha=0.3)
axes.set(xlabel="reading", ylabel="distance (m)")
show_figure(figure, text="numbers_with_doubt/readings")

# %% [markdown]
# About two thirds of the readings lie within one σ of the mean, and about 95 % within two. This is so for many kinds of noise.
#
# Now the robot takes the mean of **four** readings at a time, so it has 25 means. **Predict** the standard deviation of these 25 means, in millimetres.

# %% role="predict"
guess_means = None  # your guess: how many millimetres?

# %%
means = readings.reshape(25, 4).mean(axis=1)
compare_guess(guess_means, round(1000 * means.std(), 1), "mm")

# %% [markdown]
# Half of σ, not a quarter: some of the four errors cancel each other, but not all. The **variances** of independent errors are added. So the sum of n readings has n times the variance, and their mean has the variance divided by n: its standard deviation is σ / √n.

# %%
# Check: the numbers in this section
assert few.mean() == 5.1 and round(variance, 4) == 0.025 and round(math.sqrt(variance), 3) == 0.158 and abs(deviations.sum()) < 1e-9
assert few.var() == variance and few.std() == math.sqrt(variance)
assert deviation == 0.0051 and round(1000 * means.std(), 1) == 2.5
distances = np.abs(readings - readings.mean()) / deviation
assert (distances < 1).mean() == 0.68 and (distances < 2).mean() == 0.96

# %% [markdown]
# ## 2 · Two numbers that belong together ([[minutes]])
#
# Where is the robot? It knows only its odometry: what its wheels have counted. 200 robots get the same command, 0.25 m/s straight ahead for 4 seconds.
#
# - **The truth** is the same for all of them: 0.95 m straight ahead. (Not 1 m, because a robot needs a moment to start.)
# - **The odometry** of each says something else. The wheels are a little larger or smaller than it assumes, and they slip.
#
# We store what the odometry says after these 4 seconds: x (ahead) and y (to the left) in metres, and yaw in radians. We store it again after 4 more seconds.

# %% tags=["long"]
places, later = [], []
for seed in range(200):
    robot = Simulation(seed=seed, start=(0.0, 0.0, 0.0), movers=False)
    for _ in range(20):
        robot.step(0.25, 0.0, dt=0.2)
    places.append(robot.odometry()[:3])  # x, y, yaw
    truth = robot.pose("robot")[:2].round(2)  # x, y
    for _ in range(20):
        robot.step(0.25, 0.0, dt=0.2)
    later.append(robot.odometry()[:3])
places, later = np.array(places), np.array(later)
print("truth:", truth)
print("odometry of the first robots:\n", places[:5].round(3))
print("standard deviations:", places.std(axis=0).round(3))

# %% [markdown]
# The odometry is wrong by 7 mm in x, by 33 mm in y, and by 0.068 radians (3.9 degrees) in yaw. But look at y **and** yaw, the last two columns. In each row they have the same sign. If the odometry believes that the robot has turned to the left, it also believes that the robot drives to the left from then on.
#
# The *[[term:covariance]]* measures such a connection: the mean of deviation **times** deviation, of two different numbers. By hand, with four robots:

# %%
small = np.array([[0.0, 0.1], [0.2, 0.3], [0.1, 0.1], [0.5, 0.7]])  # columns: y, yaw
d = small - small.mean(axis=0)
print(d.round(2))
print("variance of y  ", (d[:, 0] * d[:, 0]).mean().round(3))
print("variance of yaw", (d[:, 1] * d[:, 1]).mean().round(3))
print("covariance     ", (d[:, 0] * d[:, 1]).mean().round(3))

# %% [markdown]
# If two numbers are too large together and too small together, all products are positive, and so is the covariance. If one number says nothing about the other, positive and negative products cancel each other, and the covariance is near 0.

# %%
# Check: the numbers of the robots
assert truth.tolist() == [0.95, 0.0]
assert places.std(axis=0).round(3).tolist() == [0.007, 0.033, 0.068] and round(math.degrees(0.068), 1) == 3.9
assert (np.sign(places[:5, 1]) == np.sign(places[:5, 2])).all()

# %% [markdown]
# ### Matrices, by hand ([[minutes]])
#
# A table of numbers with rows and columns is called a *[[term:matrix]]* (plural: matrices). In NumPy it is an array with two axes, and `@` multiplies two of them. The number in row i and column j of the product comes from **row i of the first** matrix and **column j of the second**: multiply them number by number, and add up.

# %%
M, N = np.array([[1, 2], [3, 4]]), np.array([[5, 6], [7, 8]])
print(M @ N)
print("row 0 with column 0:", 1 * 5 + 2 * 7, "  row 0 with column 1:", 1 * 6 + 2 * 8)
print("M times a vector:", M @ np.array([5, 7]))
print("M.T\n", M.T)

# %% [markdown]
# - Row 1 with column 0 is 3 · 5 + 4 · 7 = 43, and row 1 with column 1 is 3 · 6 + 4 · 8 = 50.
# - A vector is multiplied as if it was a single column.
# - The order counts: `N @ M` is another matrix.
# - `M.T` is M *transposed*: its rows are the columns of M. In formulas it is written Mᵀ.
#
# Now both variances and the covariance fit into one table, the *covariance matrix* C: the variances on the diagonal, and the covariance beside it, twice. Row i of `d.T` holds all deviations of the number i, and column j of `d` those of the number j. So `d.T @ d` multiplies them and adds up:

# %%
C = d.T @ d / len(d)
print(C.round(3))

# %%
# Check: the numbers of the matrices
assert (M @ N).tolist() == [[19, 22], [43, 50]] and (N @ M != M @ N).any()
assert np.allclose(C, np.cov(small.T, bias=True)) and C.round(3).tolist() == [[0.035, 0.045], [0.045, 0.06]]

# %% [markdown]
# ### Your turn: the covariance matrix
#
# Write `covariance(samples)`. Divide by the number of samples, as above.
#
# | Input | Output | Example call |
# |---|---|---|
# | `samples`: (N, n) float: N measurements, each with n numbers | (n, n) float: the variances on the diagonal, and the covariance of the numbers i and j at `[i, j]` | `covariance(small)` returns `C` |

# %% role="exercise"
exercise(
    "doubt-covariance",
    title="The covariance matrix",
    function="covariance",
    tolerance=1e-9,
    hint="Subtract the mean of each column; then d.T @ d, divided by the number of rows.",
    hints=(
        "How far is each measurement from the mean of its column, and which products does each place of the matrix add up?",
        "1. The mean of each column: mean(axis=0). Subtract it.\n"
        "2. The products, added up over all measurements: d.T @ d.\n"
        "3. Divide by the number of measurements, len(samples).",
        "d = samples - samples.mean(axis=...)\nreturn d.T @ ... / len(...)",
    ),
    explanation="d.T has one row for each number, d one column for each number. So d.T @ d multiplies column i with column j of"
    " the deviations and adds up: with i = j these are the squares. The result is symmetric.",
    another_way="NumPy has it as np.cov(samples.T, bias=True). Without bias=True, it divides by N - 1.",
)


def cloud(rng, count, mix):
    """Measurements whose numbers belong together, far from 0."""
    spread = rng.normal(0, 1, (count, len(mix))) @ np.array(mix)
    return (spread + rng.uniform(2, 4, len(mix))).round(2)


# %% role="answer"
def covariance(samples):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    return d.T @ d / len(samples)


# %% role="check"
check("doubt-covariance", covariance)

# %% role="case" title="two numbers" points=1
def inputs(rng):
    small = np.array([[0.0, 0.1], [0.2, 0.3], [0.1, 0.1], [0.5, 0.7]])
    return [(small,), (cloud(rng, 6, [[0.5, 0.3], [0.0, 0.2]]),)]


# %% role="case" title="one falls when the other grows" points=1 hint="A covariance can be negative: is it the mean of the products, without abs?"
def inputs(rng):
    return [(cloud(rng, 5, [[0.6, -0.5], [0.1, 0.2]]),), (cloud(rng, 8, [[0.1, -0.4], [0.3, -0.2]]),)]


# %% role="hidden" title="three numbers" points=1 hint="Does it work for any number of columns?"
def inputs(rng):
    mix = [[0.5, 0.2, -0.4], [0.0, 0.3, 0.2], [0.1, 0.0, 0.6]]
    return [(cloud(rng, 7, mix),), (cloud(rng, 20, mix),), (cloud(rng, 9, [[0.7]]),)]


# %% [markdown]
# ## 3 · How far, in units of the doubt ([[minutes]])
#
# The odometry of a new robot says: 6 cm more to the left than the mean. Is this much? In metres, no answer is fair: 6 cm are about 2 σ in y, and would be 9 σ in x. So we measure in units of the doubt. With one number, the *squared distance* is d² / σ², or d · (1 / σ²) · d.
#
# With two numbers, the inverse matrix takes the place of 1 / σ². The *[[term:inverse]]* of a matrix undoes it: multiplied with the matrix, it gives 1 on the diagonal and 0 beside it (the *identity matrix*).

# %%
M = np.array([[2.0, 1], [1, 1]])
inverse = np.linalg.inv(M)
print(inverse.round(3) + 0.0)
print((inverse @ M).round(3) + 0.0)

# %% [markdown]
# By hand, the first row: 1 · 2 − 1 · 1 = 1, and 1 · 1 − 1 · 1 = 0. Only square matrices have an inverse, and not all of them.
#
# So for the deviations d of y and yaw, the squared distance is `d @ np.linalg.inv(C) @ d`. Two new robots:

# %%
d = places[:, 1:] - places[:, 1:].mean(axis=0)  # y, yaw
C = d.T @ d / len(d)
for new in ([0.06, 0.12], [0.06, -0.12]):
    new = np.array(new)
    print("deviations", new, "  squared distance", round(float(new @ np.linalg.inv(C) @ new)))

# %% [markdown]
# Each number alone is just as far from the mean. But the first odometry says that the robot is too far to the left and has turned to the left, as is usual. The second one says too far to the left, but turned to the right: this never happens.
#
# How far is too far? For two numbers with the usual bell-shaped noise, **1 %** of all squared distances are larger than 9.21. **Predict** how many of our 200 robots have a larger one.

# %% role="predict"
guess_outside = None  # your guess: how many of 200 robots?

# %%
def squared_distances(d, C):  # of each row of d
    return ((d @ np.linalg.inv(C)) * d).sum(axis=-1)


outside = squared_distances(d, C) > 9.21
compare_guess(guess_outside, int(outside.sum()))

# %% [markdown]
# We expect two. Five or more are no reason to worry: in one of 20 such groups of 200 robots, it happens by chance. All places with the same squared distance form an *ellipse*:

# %% tags=["long"]
y, yaw = np.meshgrid(np.linspace(-0.15, 0.15, 200), np.linspace(-0.3, 0.3, 200))
grid = squared_distances(np.stack([y, yaw], axis=-1), C)
figure = Figure(figsize=(7, 3.2), layout="constrained")
axes = figure.subplots()
axes.contour(y, yaw, grid.round(2), [9.21], colors="k", linewidths=1)
axes.plot(*d[~outside].round(4).T, ".", markersize=3)
axes.plot(*d[outside].round(4).T, "r.")
axes.set(xlabel="deviation of y (m)", ylabel="deviation of yaw (rad)")
show_figure(figure, text="numbers_with_doubt/robots")

# %% [markdown]
# The ellipse is thin, so yaw says almost everything about y: if you measure the yaw of a robot, you also learn its y. In [[object_tracking#5]] the limit 9.21 is called a *gate*: what lies outside probably belongs to something else.

# %%
# Check: the numbers in this section; 9.21 belongs to 1 %, and 5 or more of 200 to 1 of 20
assert np.allclose(inverse, [[1, -1], [-1, 2]]) and (0.06 / places.std(axis=0)).round()[:2].tolist() == [9, 2]
assert outside.sum() == 5 and round(squared_distances(np.array([0.06, 0.12]), C)) == 4
chances = [math.comb(200, k) * 0.01**k * 0.99**(200 - k) for k in range(5)]
assert round(1 - sum(chances), 2) == 0.05
assert round(math.exp(-9.21 / 2), 3) == 0.01

# %% [markdown]
# ## 4 · The doubt drives on ([[minutes]])
#
# The robot drives 1 m more, straight ahead. Let us say that the wheels make no new error on this metre. Then the odometry computes the same yaw, and its y grows by 1 m times yaw. (For small angles in radians, the sine of the angle is the angle.) This is a product with a matrix F: the first row says y + 1 · yaw, the second one says yaw.
#
# $$\begin{pmatrix} y_{\text{new}} \\ \text{yaw}_{\text{new}} \end{pmatrix} = F \begin{pmatrix} y \\ \text{yaw} \end{pmatrix}, \qquad F = \begin{pmatrix} 1 & 1 \\ 0 & 1 \end{pmatrix}$$
#
# Now y is uncertain by 3.3 cm. The yaw is uncertain by 0.068 radians, which is 6.8 cm to the side on one metre. **Predict** by how many centimetres y is uncertain after this metre.

# %% role="predict"
guess_further = None  # your guess: how many centimetres?

# %%
F = np.array([[1.0, 1.0], [0.0, 1.0]])
after = d @ F.T  # F @ row, for each row
compare_guess(guess_further, round(100 * after[:, 0].std()), "cm")

# %% [markdown]
# If both errors were independent, their variances would be added: √(3.3² + 6.8²) = 7.6 cm. But they belong together. The new deviation of y is d_y + d_yaw, and its square is d_y² + 2 · d_y · d_yaw + d_yaw². The mean of this is variance + 2 · covariance + variance:
#
# 0.0011 + 2 · 0.0022 + 0.0047 = 0.0102 m², and its root is 0.10 m.
#
# Here we moved 200 robots. A real robot has only its covariance matrix C. Can C be moved directly? Each number in C is a mean of deviation times deviation, and F moves **both** deviations. So F is multiplied to C twice: from the left, and transposed from the right.

# %%
print("C\n", C.round(4))
print("of the moved robots\n", (after.T @ after / len(after)).round(4))
print("F @ C @ F.T\n", (F @ C @ F.T).round(4))

# %% [markdown]
# Both are equal. So the robot knows how its doubt grows. This is the line F C Fᵀ of the [[term:Kalman filter]] in [[object_tracking#4]].
#
# And the 200 robots that drove on for 4 seconds? Their wheels were wrong on the second metre too, so the y of their odometry is uncertain by 13 cm, not by 10. F knows nothing about this. A filter adds the missing part: a second covariance matrix, Q.

# %%
# Check: the numbers in this section
assert np.allclose(after.T @ after / len(after), F @ C @ F.T) and (100 * d.std(axis=0)).round(1).tolist() == [3.3, 6.8]
assert round(math.hypot(3.3, 6.8), 1) == 7.6 and C.round(4).tolist() == [[0.0011, 0.0022], [0.0022, 0.0047]]
assert round(0.0011 + 2 * 0.0022 + 0.0047, 4) == round((F @ C @ F.T)[0, 0], 4) == 0.0102 and round(math.sqrt(0.0102), 2) == 0.1
assert round(100 * after[:, 0].std()) == 10 and round(100 * later[:, 1].std()) == 13

# %% [markdown]
# **This is a good place for a pause.** When you come back, choose **Run → Run All Above Selected Cell**.
#
# ## 5 · A line through many points ([[minutes]])
#
# We look for the line y = slope · x + offset that fits many points best. Best means: the errors in y are squared and added up, and this sum is as small as possible. This is called *[[term:least squares]]*. You met it in [[obstacles_ahead#4]], for a plane.
#
# First a matrix A with one row for each point: what is multiplied by the slope (x), and what is multiplied by the offset (1). Then `A @ (slope, offset)` is the y of the line at each point. `np.linalg.lstsq` finds the two numbers:

# %%
x, y = np.array([0.0, 1.0, 2.0]), np.array([1.0, 3.0, 2.0])
A = np.column_stack([x, np.ones(3)])
p = np.linalg.lstsq(A, y)[0]
print(A)
print("slope and offset", p.round(3), "  errors", (A @ p - y).round(3))

# %% [markdown]
# How does it find them? Think of the line as a stick, and of each error as a spring that pulls the stick to its point. At the best line, the pulls are in balance:
#
# - they do not shift the line: the sum of the errors is 0, here 0.5 − 1 + 0.5;
# - they do not turn it: the sum of x · error is 0, here 0 · 0.5 − 1 · 1 + 2 · 0.5.
#
# Both sums are one product, Aᵀ · errors, because the columns of A are x and 1. The errors are A p − y, where p is (slope, offset). So
#
# $$A^T (A \; p - y) = 0, \qquad \text{or} \qquad A^T A \; p = A^T y$$
#
# These are the *[[term:normal equations]]*: as many equations as unknowns, here two. `np.linalg.solve(M, b)` finds the p for which M @ p is b:

# %%
print(A.T @ A, A.T @ y)
print("solve:", np.linalg.solve(A.T @ A, A.T @ y).round(3))

# %% [markdown]
# The rows say 5 · slope + 3 · offset = 7, and 3 · slope + 3 · offset = 6. The difference is 2 · slope = 1. So the slope is 0.5 and the offset is 1.5, as above.

# %%
# Check: both ways, one line
errors = A @ p - y
assert np.allclose(p, (0.5, 1.5)) and np.allclose(errors, (0.5, -1.0, 0.5)) and np.allclose(np.linalg.solve(A.T @ A, A.T @ y), p)
assert abs(errors.sum()) < 1e-9 and abs((x * errors).sum()) < 1e-9 and np.allclose(A.T @ errors, ((x * errors).sum(), errors.sum()))
assert (A.T @ A).tolist() == [[5, 3], [3, 3]] and (A.T @ y).tolist() == [7, 6]

# %% [markdown]
# ### The direction of a wall ([[minutes]], deeper)
#
# A robot can drive along a wall if it knows in which direction the wall runs. In the room the wall runs along x. The robot is turned to the left by 0.2 radians (11.5 degrees). So seen from the robot, the wall should be turned to the right by 11.5 degrees. The robot fits a line to the ends of twelve rays:

# %%
robot = Simulation(seed=4, start=(0.45, 0.5, 0.2), movers=False)
numbers = np.arange(60, 120, 5)  # rays to the left: 60 to 115 degrees
ranges, angles = robot.scan().ranges[numbers], np.radians(numbers)
wall = np.column_stack([ranges * np.cos(angles), ranges * np.sin(angles)])
slope, offset = np.linalg.lstsq(np.column_stack([wall[:, 0], np.ones(12)]), wall[:, 1])[0]
print("slope", slope.round(3), "  angle", round(math.degrees(math.atan(slope)), 1), "degrees")

# %%
figure = Figure(figsize=(6, 3.2), layout="constrained")
axes = figure.subplots()
axes.plot(0, 0, "k>", markersize=10)
axes.plot(*wall.round(3).T, ".")
ends = np.array([wall[:, 0].min(), wall[:, 0].max()])
axes.plot(ends.round(3), (slope * ends + offset).round(3), linewidth=1)
axes.set(xlabel="x (m), ahead", ylabel="y (m), to the left", aspect="equal")
show_figure(figure, text="numbers_with_doubt/wall")

# %%
# Check: the angle of the wall, and its standard deviation
spread = wall[:, 0] - wall[:, 0].mean()
assert round(math.degrees(0.0051 / math.sqrt((spread**2).sum())), 2) == 0.15
assert wall.shape == (12, 2) and abs(math.degrees(math.atan(slope)) + 11.4) < 0.049 and round(math.degrees(0.2), 1) == 11.5

# %% [markdown]
# The line falls by 11.4 degrees, and the truth is 11.5. Each ray is wrong by about 5 mm (section 1), so the direction of the line is uncertain by 0.15 degrees: an error of 0.1 degrees is usual. To drive along the wall, the robot turns to the right by 11.4 degrees.

# %% [markdown]
# ## 6 · Weights ([[minutes]])
#
# Not all measurements are equally good. The laser scanner says that a wall is 2.00 m away, with σ₁ = 0.01 m. The wheels say 2.10 m, with σ₂ = 0.02 m. What is the best answer? We take a share g of the second number, and the share 1 − g of the first. An error e of the first number then changes the answer only by (1 − g) · e, and its square by (1 − g)² · e². So the variance of this mix is (1 − g)² σ₁² + g² σ₂². Try some shares:

# %%
for g in (0.0, 0.1, 0.2, 0.3, 0.5, 1.0):
    variance = (1 - g)**2 * 0.01**2 + g**2 * 0.02**2
    print("share", g, "  place", round(2.00 + 0.10 * g, 2), "  variance", round(variance, 6))

# %% [markdown]
# The best share is 0.2, and its variance is smaller than that of the better sensor alone. So a bad measurement still helps! The rule behind it: each measurement has the *weight* 1 / σ², and the best answer is the weighted mean. Here the weights are 10,000 and 2,500, and 2500 / 12500 = 0.2.
#
# A third sensor says 2.04 m, with σ = 0.01 m. **Predict** the weighted mean of all three.

# %% role="predict"
guess_mean = None  # your guess: how many metres?

# %%
values, sigmas = np.array([2.00, 2.10, 2.04]), np.array([0.01, 0.02, 0.01])
weights = 1 / sigmas**2
weighted_mean = (weights * values).sum() / weights.sum()
compare_guess(guess_mean, round(weighted_mean, 2), "m")

# %% [markdown]
# Least squares takes weights in the same way: make the sum of weight · error² small. In the normal equations, the weights stand in a diagonal matrix W between Aᵀ and A: $A^T W A \; p = A^T W y$.

# %%
# Check: the numbers in this section
shares = np.linspace(0, 1, 101)
assert shares[((1 - shares)**2 * 0.01**2 + shares**2 * 0.02**2).argmin()] == 0.2 and 0.64 * 1e-4 + 0.04 * 4e-4 < 1e-4
assert np.allclose(weights, [10000, 2500, 10000]) and 2500 / 12500 == 0.2 and round(weighted_mean, 2) == 2.03

# %% [markdown]
# ### Your turn: a line with weights ([[minutes]], deeper)
#
# Or you divide each row of A and each y by its σ, and call `lstsq` as before: then each error is in units of its own σ, and its square has the weight 1 / σ². The three points again, but the last one is very uncertain:

# %%
sigmas = np.array([0.1, 0.1, 10.0])
rows = A / sigmas[:, np.newaxis]
print("slope and offset:", np.linalg.lstsq(rows, y / sigmas)[0].round(3))

# %%
# Check: both ways, one line, nearly through the first two points
W = np.diag(1 / sigmas**2)
assert np.allclose(np.linalg.solve(A.T @ W @ A, A.T @ W @ y), np.linalg.lstsq(rows, y / sigmas)[0])
assert np.allclose(np.linalg.lstsq(rows, y / sigmas)[0], (2, 1), atol=1e-3)

# %% [markdown]
# The line passes through the first two points, and the last one has almost no say.
#
# Write `fit_line(x, y, sigmas)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `x`, `y`: (N,) float, the points; `sigmas`: (N,) float, the standard deviation of each y | two floats: slope and offset of the line with the smallest sum of (error / σ)² | `fit_line(x, y, np.ones(3))` returns `0.5, 1.5` |

# %% role="exercise"
exercise(
    "doubt-line",
    title="A line with weights",
    function="fit_line",
    tolerance=1e-6,
    hint="Two columns, x and ones; divide them and y by sigmas; np.linalg.lstsq(...)[0] has slope and offset.",
    hints=(
        "Which row does each point give, and by what do you divide the row and its y?",
        "1. The matrix with the columns x and 1: np.column_stack.\n"
        "2. Divide each row by the sigma of its point: sigmas[:, np.newaxis] has one column.\n"
        "3. Divide y by sigmas as well.\n"
        "4. The first result of np.linalg.lstsq has the slope and the offset.",
        "A = np.column_stack([x, np.ones(...)])\nrows = A / sigmas[:, np.newaxis]\n"
        "slope, offset = np.linalg.lstsq(rows, y / ...)[0]\nreturn slope, ...",
    ),
    explanation="Divided by its own sigma, each error counts in units of its doubt: an exact point pulls the line hard, an"
    " uncertain one hardly at all. The square of the division is the weight 1 / sigma².",
    another_way="You can also solve the normal equations A.T @ W @ A p = A.T @ W @ y with W = np.diag(1 / sigmas**2), or use"
    " the weighted means of x and y.",
)


def noisy_line(rng, count, low=0.05, high=0.8):
    """Points near a line, each with its own doubt."""
    x = rng.uniform(-2, 3, count).round(2)
    sigmas = rng.uniform(low, high, count).round(2)
    y = rng.uniform(-1.5, 1.5) * x + rng.uniform(1, 2) + sigmas * rng.normal(0, 1, count)
    return x, y.round(3), sigmas


# %% role="answer"
def fit_line(x, y, sigmas):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    slope, offset = np.linalg.lstsq(A / sigmas[:, np.newaxis], y / sigmas)[0]
    return float(slope), float(offset)


# %% role="check"
check("doubt-line", fit_line)

# %% role="case" title="equal doubts" points=1
def inputs(rng):
    x, y, _ = noisy_line(rng, 6)
    return [(np.array([0.0, 1, 2]), np.array([1.0, 3, 2]), np.ones(3)), (x, y, np.full(6, 0.2))]


# %% role="case" title="some points are uncertain" points=1 hint="Does each point count with 1 / sigma²? Divide its row and its y by sigma, once."
def inputs(rng):
    return [(np.array([0.0, 1, 2]), np.array([1.0, 3, 2]), np.array([0.1, 0.1, 10.0])), noisy_line(rng, 7)]


# %% role="hidden" title="any points" points=1 hint="Do slope and offset come in this order, for any number of points?"
def inputs(rng):
    return [noisy_line(rng, count) for count in (3, 12, 40)]


# %% [markdown]
# ## 7 · One step of Gauss-Newton ([[minutes]])
#
# Where is the robot? It drives along a straight line, and only **one** number is unknown: the x of its camera at the first look. The marker hangs at x = 4.34 m, 1.62 m to the right of this line. The depth camera measures the distance to the marker at three looks. Between them, the wheels count how far the robot drives:

# %%
distances = np.array([3.88, 3.70, 3.47])  # to the marker, metres
ways = np.array([0.0, 0.20, 0.45])  # driven until then, metres

# %% [markdown]
# If the camera began at x, then at each look the marker is `4.34 - way - x` ahead and 1.62 m aside. The law of Pythagoras computes the distance from these two. The *errors* are the computed distances minus the measured ones:

# %%
ahead = 4.34 - ways  # seen from the place x = 0


def errors_of(x):
    return np.hypot(ahead - x, 1.62) - distances


for x in (0.0, 1.0, 2.8):
    print("x", x, "  errors", errors_of(x).round(2), "  sum of squares", (errors_of(x)**2).sum().round(2))

# %% [markdown]
# It would take long to try all x. The *[[term:Gauss-Newton method]]* needs only a few tries. It asks: if x grows a little, how does each error change? This change, divided by the change of x, is one number for each error. Together these numbers are the *[[term:Jacobian]]* J. We try it at x = 2.8 with a tiny change. Calculus gives the same by a formula, −(ahead − x) / distance, with the **computed** distance, not the measured one:

# %%
x = 2.8
tried = (errors_of(x + 1e-6) - errors_of(x)) / 1e-6
J = -(ahead - x) / np.hypot(ahead - x, 1.62)
print(tried.round(3), J.round(3))

# %% [markdown]
# After a step, the errors are about `errors + J * step`. We want all of them to be 0. These are three equations with one unknown, the step, so they cannot all be true. Least squares finds the step that fits best, with J in the place of A and −errors in the place of y: JᵀJ · step = −Jᵀ · errors. With one unknown, JᵀJ is one number, and we only divide. (Σ means: add up over all looks.)
#
# $$\text{step} = \frac{-\sum J \cdot \text{error}}{\sum J \cdot J}$$
#
# **Predict** x after this step, from x = 2.8. (The true x is 0.81 m.)

# %% role="predict"
guess_step = None  # your guess: which x?

# %%
step = -(J * errors_of(x)).sum() / (J * J).sum()
compare_guess(guess_step, round(x + step, 2), "m")

# %% [markdown]
# The step does not reach the goal, because the errors are not straight lines. So compute errors and J **again** at the new place, do the next step, and so on:

# %%
def next_x(x):
    J = -(ahead - x) / np.hypot(ahead - x, 1.62)
    return float(x - (J * errors_of(x)).sum() / (J * J).sum())


for _ in range(5):
    x = next_x(x)
    print(round(x, 3), end="  ")

# %% [markdown]
# After three steps, x stays at 0.816. The truth is 0.81: the measured distances are a little wrong too, so 6 mm are left. The first guess must not be too bad; the odometry gives a good one.
#
# In [[mapping_and_slam#7]] the same step corrects 32 poses at once: there J is a matrix, with one row for each error and one column for each unknown.

# %%
# Check: the numbers in this section
assert np.allclose(tried, J, atol=1e-4) and round(2.8 + float(step), 2) == 0.29
assert round(next_x(next_x(next_x(2.8))), 3) == round(next_x(0.816), 3) == 0.816 and round(1000 * (0.816 - 0.81)) == 6

# %% [markdown]
# ### Your turn: one step ([[minutes]], deeper)
#
# Write `place_step(x, ahead, aside, distances, sigmas)`: one step, with weights. Each look has its own number in each array. With the weights w = 1 / σ²,
#
# $$\text{step} = \frac{-\sum w \cdot J \cdot \text{error}}{\sum w \cdot J \cdot J}$$
#
# Σ means: add up over all looks. The distance in J is the one that x would give: computed, not measured.
#
# | Input | Output | Example call |
# |---|---|---|
# | `x`: float, the guess; `ahead`, `aside`: (N,) float, where the thing of each look is, seen from the place x = 0; `distances`: (N,) float, what was measured; `sigmas`: (N,) float, its standard deviation; all in metres | float: x after **one** step | `place_step(2.8, ahead, np.full(3, 1.62), distances, np.ones(3))` returns about `0.286` |

# %% role="exercise"
exercise(
    "doubt-step",
    title="One step of Gauss-Newton",
    function="place_step",
    tolerance=1e-6,
    hint="errors = hypot(ahead - x, aside) - distances; J = -(ahead - x) / hypot(ahead - x, aside); x - sum(w * J * errors) / sum(w * J * J).",
    hints=(
        "What are the errors at x, how does each of them change with x, and how much does each count?",
        "1. How far ahead each thing is from x: ahead - x. With aside and np.hypot: the distances that x would give.\n"
        "2. The errors: these distances minus the measured ones.\n"
        "3. J: minus (ahead - x), divided by the distances that x would give.\n"
        "4. The weights: 1 / sigmas**2.\n"
        "5. Return x minus the sum of w * J * errors, divided by the sum of w * J * J.",
        "expected = np.hypot(ahead - x, ...)\nerrors = expected - ...\nJ = -(ahead - x) / ...\nw = 1 / ...\n"
        "return x - (w * J * errors).sum() / ...",
    ),
    explanation="The errors change with x as J says. The step makes the weighted sum of squares smallest, as if the errors were"
    " straight lines. With sigmas, an exact measurement counts more than a rough one.",
    another_way="You can also write J as a matrix of one column, and solve J.T @ W @ J step = -J.T @ W @ errors.",
)


def some_looks(rng, count, x, off):
    """Looks at things from the place x, with errors, and a guess that is so far off."""
    ahead, aside = rng.uniform(2, 5, count).round(2), rng.uniform(-2, 2, count).round(2)
    sigmas = rng.uniform(0.02, 0.3, count).round(2)
    distances = np.hypot(ahead - x, aside) + sigmas * rng.normal(0, 1, count)
    return round(x + off, 2), ahead, aside, distances.round(3), sigmas


# %% role="answer"
def place_step(x, ahead, aside, distances, sigmas):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = -(ahead - x) / expected
    w = 1 / sigmas**2
    return float(x - (w * J * (expected - distances)).sum() / (w * J * J).sum())


# %% role="check"
check("doubt-step", place_step)

# %% role="case" title="one thing, and the looks of the lesson" points=1
def inputs(rng):
    ahead, distances = np.array([4.34, 4.14, 3.89]), np.array([3.88, 3.7, 3.48])
    guess = round(float(rng.uniform(1.6, 2.4)), 2)
    return [(0.0, np.array([3.0]), np.array([4.0]), np.array([4.5]), np.array([0.1])), (guess, ahead, np.full(3, 1.62), distances, np.ones(3)), some_looks(rng, 4, 0.3, -0.5)]


# %% role="case" title="measurements with different doubts" points=1 hint="Do the weights 1 / sigma² count in both sums?"
def inputs(rng):
    return [some_looks(rng, 4, 0.5, 0.6), some_looks(rng, 5, -0.4, -0.8)]


# %% role="hidden" title="any looks" points=1 hint="Is it one step, and does x grow or fall as the errors demand?"
def inputs(rng):
    return [some_looks(rng, 6, 0.2, 1.0), some_looks(rng, 3, 1.0, -0.5), some_looks(rng, 12, -1.0, 0.4)]


# %% [markdown]
# ### The second valley ([[minutes]], deeper)
#
# Here is the sum of squares for each place, as a curve. Near x = 2.8, the straight lines `errors + J * step` make a parabola of it, and the step goes to the lowest point of this parabola:

# %% tags=["long"]
start = 2.8
J_start = -(ahead - start) / np.hypot(ahead - start, 1.62)
places_x, near = np.linspace(-1.2, 9, 200), np.linspace(-1.5, 3.2, 60)
sums = [(errors_of(place)**2).sum() for place in places_x]
parabola = [((errors_of(start) + J_start * (place - start))**2).sum() for place in near]
figure = Figure(figsize=(7, 3), layout="constrained")
axes = figure.subplots()
axes.plot(places_x, np.round(sums, 3), color="0.5", label="sum of squares")
axes.plot(near, np.round(parabola, 3), "b--", label="parabola of the step")
axes.plot([start, next_x(start)], np.round([(errors_of(start)**2).sum(), min(parabola)], 3), "bo")
axes.set(xlabel="x (m)", ylabel="sum of squares (m²)", ylim=(-0.5, 12))
axes.legend()
show_figure(figure, text="numbers_with_doubt/valley")

# %% [markdown]
# A step goes down into the nearest valley. There is a second one, behind the marker. A robot that begins its search there ends there:

# %%
x = 7.0
for _ in range(5):
    x = next_x(x)
    print(round(x, 3), end="  ")

# %%
# Check: the largest error in both valleys, in metres
assert round(x, 3) == 7.426 and round(float(np.abs(errors_of(x)).max()), 2) == 0.42 and np.abs(errors_of(0.816)).max() < 0.01

# %% [markdown]
# How does the robot notice this? By the errors that are left: up to 42 cm, and less than 1 cm in the right valley. So look at the errors at the end, or start from several guesses.

# %% [markdown]
# ### How the distances were measured ([[minutes]], deeper)
#
# The depth image gives the depth of the marker, and its ray makes a distance of it, as in [[obstacles_ahead#2]]. The camera is 0.21 m before the middle of the robot.

# %% tags=["long"]
robot = Simulation(seed=3, start=(0.6, 1.0, 0.0), movers=False)
marker, camera = robot.pose("marker"), robot.depth_camera()
for _ in range(3):
    rows, cols = np.nonzero(robot.labels() == 13)  # 13 is the marker
    ray = camera.unproject((cols.mean(), rows.mean()))
    depth = np.median(robot.depth()[rows, cols]) / 1000
    print("distance", (depth * np.linalg.norm(ray)).round(2), "  driven", round(robot.odometry().x, 2))
    for _ in range(5):
        robot.step(0.25, 0.0, dt=0.2)

# %%
# Check: these are the numbers of this section
assert marker[:2].round(2).tolist() == [4.34, -0.62] and round(1.0 - marker[1], 2) == 1.62 and round(0.6 + 0.21, 2) == 0.81
assert abs(depth * np.linalg.norm(ray) - 3.47) < 0.006 and robot.label_names[13] == "marker"

# %% [markdown]
# ## 8 · Rotate, stretch, rotate ([[minutes]])
#
# What does a matrix do to the plane? Every matrix does the same three things: it **rotates**, then it **stretches or shrinks** along the two axes, then it **rotates** again. (One of the rotations may also be a mirror.) The *[[term:singular value decomposition]]*, SVD, finds the three parts: `U, s, V = np.linalg.svd(M)`, and M is `U @ np.diag(s) @ V`. Read it from the right: first V, then s, then U. (Many books call the third part Vᵀ.)
#
# The numbers in s are sorted, the largest first. Row k of V is the direction that is stretched by `s[k]`, and column k of U is where this direction goes.
#
# We take F of section 4. Each computer may choose other signs, because row k of V and column k of U can both be multiplied by −1. So we choose: V has positive numbers on its diagonal.

# %%
U, s, V = np.linalg.svd(F)
signs = np.sign(np.diag(V))
U, V = U * signs, V * signs[:, np.newaxis]  # columns of U, rows of V
print("s", s.round(3))

# %% tags=["long"]
angles = np.linspace(0, 2 * math.pi, 200)
circle = np.array([np.cos(angles), np.sin(angles)])
figure = Figure(figsize=(9, 2.6), layout="constrained")
stages = {"a circle": np.eye(2), "V rotates": V, "s stretches": np.diag(s) @ V, "U rotates: F": F}
for axes, (title, M) in zip(figure.subplots(1, 4, sharey=True), stages.items(), strict=True):
    axes.plot(*(M @ circle).round(3), color="0.5")
    for (a, b), colour in zip(M.T.round(3), "rb", strict=True):  # where (1, 0) and (0, 1) go
        axes.plot([0, a], [0, b], f"{colour}o-", markevery=[1])
    axes.set(title=title, xlim=(-1.8, 1.8), ylim=(-1.8, 1.8), aspect="equal")
show_figure(figure, text="numbers_with_doubt/svd")

# %%
# Check: the numbers in this section
assert np.allclose(U @ np.diag(s) @ V, F) and np.allclose(U @ U.T, np.eye(2)) and np.allclose(V @ V.T, np.eye(2))
assert round(np.linalg.det(U)) == round(np.linalg.det(V)) == 1 and s[0] > s[1]
assert all(np.allclose(F @ V[k], s[k] * U[:, k]) for k in range(2))

# %% [markdown]
# ### The nearest rotation
#
# Now the **planned failure**. The robots start backward: their yaw is π, half a turn. They drive as before. In which direction does their odometry say that they look, on average?

# %%
yaws = np.array([math.remainder(math.pi + yaw, 2 * math.pi) for yaw in places[:, 2]])
print("first yaws:", yaws[:5].round(2))
print("their mean:", round(abs(float(yaws.mean())), 1))

# %% [markdown]
# The mean of 3.1 and −3.1 is 0: these robots would look ahead! (It is 0.3 and not 0, because 110 of the 200 yaws are positive and only 90 are negative.) Angles jump at π, so no mean of angles is safe.
#
# A rotation **matrix** does not jump. Its columns show where the two axes go. So take the mean of the 200 matrices:

# %%
rotations = np.array([[[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]] for a in yaws])
mean = rotations.mean(axis=0)
print(mean.round(4))
print("lengths of its columns:", np.linalg.norm(mean, axis=0).round(4))

# %% [markdown]
# This is nearly half a turn, but no rotation: it makes everything a little shorter. **Repair it** with the SVD: rotate, stretch, rotate, and leave the stretching out. `U @ V` is the *nearest rotation*: no other one has a smaller sum of squared differences from the matrix. (If the [[term:determinant]] is negative, it is a mirror; [[where_am_i#5]] shows what to do then.) The signs of U and V do not matter here, because they cancel each other.

# %%
U, s, V = np.linalg.svd(mean)
nearest = U @ V
print("s", s.round(4))
angle = abs(math.degrees(math.atan2(nearest[1, 0], nearest[0, 0])))
print("the mean direction:", round(angle), "degrees")

# %%
# Check: the numbers in this section
assert (yaws > 0).sum() == 110 and (yaws < 0).sum() == 90 and round(yaws.mean(), 1) == 0.3
assert abs(math.remainder(math.radians(angle) - math.pi - places[:, 2].mean(), 2 * math.pi)) < 0.02 and round(angle) == 180
assert s.max() < 1 and np.allclose(nearest @ nearest.T, np.eye(2))
turns = [np.array([[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]]) for a in np.linspace(0, 6.28, 300)]
assert ((nearest - mean)**2).sum() <= min(((turn - mean)**2).sum() for turn in turns)

# %% [markdown]
# ### Your turn: the mean of rotations ([[minutes]], deeper)
#
# Write `mean_rotation(rotations)`, also for rotations in the room, with three rows and columns.
#
# | Input | Output | Example call |
# |---|---|---|
# | `rotations`: (N, n, n) float, N rotation matrices that are not far from each other | (n, n) float: the rotation that is nearest to their mean | `mean_rotation(rotations)` returns about half a turn, `[[-1, 0], [0, -1]]` |

# %% role="exercise"
exercise(
    "doubt-rotation",
    title="The mean of rotations",
    function="mean_rotation",
    tolerance=1e-6,
    hint="U, s, V = np.linalg.svd(rotations.mean(axis=0)); return U @ V.",
    hints=(
        "Over which axis is the mean of N matrices a matrix, and which of the three parts of the SVD do you leave out?",
        "1. The mean of the matrices: mean(axis=0).\n"
        "2. Its SVD gives U, s and V.\n"
        "3. Multiply U and V with @, without s.",
        "U, s, V = np.linalg.svd(rotations.mean(axis=...))\nreturn U @ ...",
    ),
    explanation="The mean of rotations stretches by numbers below 1, in s. Without them, only the two rotations U and V are left,"
    " and their product is the nearest rotation to the mean.",
    another_way="In the plane you can also take the angle of the mean, math.atan2(mean[1, 0], mean[0, 0]), and build the matrix"
    " from its cosine and sine. SciPy has Rotation.mean.",
)


def turned(axis, angle):
    """The rotation in the room about an axis, by the formula of Rodrigues."""
    x, y, z = axis / np.sqrt((axis * axis).sum())
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def in_plane(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def about(rng, middle, spread, count):
    """Rotations in the plane around an angle."""
    return np.array([in_plane(middle + part) for part in spread * rng.uniform(-1, 1, count)]).round(6)


def in_room(rng, count, spread):
    first = turned(rng.normal(0, 1, 3), rng.uniform(0.5, 2.5))
    return np.array([first @ turned(rng.normal(0, 1, 3), spread * rng.uniform(0.2, 1)) for _ in range(count)]).round(6)


# %% role="answer"
def mean_rotation(rotations):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def mean_rotation(rotations):
    U, _, V = np.linalg.svd(rotations.mean(axis=0))
    return U @ V


# %% role="check"
check("doubt-rotation", mean_rotation)

# %% role="case" title="directions in the plane" points=1
def inputs(rng):
    across = np.array([in_plane(angle) for angle in (3.0, -3.0, 2.8, -2.6)]).round(6)
    return [(across,), (about(rng, 0.5, 0.8, 4),)]


# %% role="case" title="rotations in the room" points=1 hint="Is U multiplied with V by @, and is s left out?"
def inputs(rng):
    return [(in_room(rng, 4, 0.7),), (in_room(rng, 6, 0.4),)]


# %% role="hidden" title="any rotations" points=1 hint="Is the mean taken over axis 0, and does it work for any size?"
def inputs(rng):
    return [(about(rng, 2.0, 0.9, 10),), (in_room(rng, 9, 0.8),), (in_room(rng, 2, 0.5),)]


# %% [markdown]
# ### The axes of an ellipse ([[minutes]], deeper)
#
# For a covariance matrix, the two rotations undo each other, and s are the variances along the axes of its ellipse. So the roots of s say how far the doubt goes in its worst and in its best direction.

# %%
worst, best = np.sqrt(np.linalg.svd(C)[1])
print("y and yaw: worst", worst.round(3), "  best", best.round(3))

# %% [markdown]
# Here a direction mixes metres with radians, so these two numbers have no clear unit: in centimetres, the axes would be others. For x and y, both in metres, they are lengths.

# %%
# Check: the best direction is nearly certain
assert round(worst, 3) == 0.076 and round(best, 3) == 0.003
in_cm = np.diag([100, 1])
assert not np.allclose(np.linalg.svd(in_cm @ C @ in_cm)[1], 100**2 * np.linalg.svd(C)[1], rtol=0.1)

# %% [markdown]
# ## Recap
#
# A measurement has a variance, and several have a covariance matrix. F C Fᵀ moves it along. Least squares finds what fits best, with the weight 1 / σ² for each measurement, and Gauss-Newton repeats it where the errors are not straight lines. The SVD takes a matrix apart, and U @ V is the nearest rotation.
#
# | here | where you need it |
# |---|---|
# | variance, weights (section 6) | [[object_tracking#4]]: the gain of the Kalman filter |
# | F C Fᵀ (section 4) | [[object_tracking#4]]: predict |
# | squared distance, 9.21 (section 3) | [[object_tracking#5]]: the gate |
# | SVD, U @ V (section 8) | [[where_am_i#5]]: the motion of a cloud of points |
# | JᵀJ · step = −Jᵀ · errors (section 7) | [[mapping_and_slam#7]]: all poses at once |
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | readings | (100,) | float64 | near 5 | metre |
# | places | (200, 3) | float64 | | metre, metre, radian |
# | covariance of y and yaw | (2, 2) | float64 | symmetric | m², m · rad, rad² |
# | A of the line | (3, 2) | float64 | | metre, 1 |
# | J of the three looks | (3,) | float64 | −1 to 1 | metre per metre |
# | mean of the rotations | (2, 2) | float64 | −1 to 1 | |
#
# **Next:** [[object_tracking]].

# %%
# Check: the numbers in the table
assert readings.shape == (100,) and places.shape == (200, 3) and C.shape == (2, 2) and A.shape == (3, 2) and J.shape == (3,)
assert np.allclose(C, C.T) and readings.dtype == places.dtype == np.float64 and np.abs(J).max() < 1
