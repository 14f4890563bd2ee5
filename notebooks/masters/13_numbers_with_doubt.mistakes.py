# %% [markdown]
# # doubt-covariance

# %% role="mistake" name="not divided" says="The products are added up, but not divided: the covariance is their mean. Divide by len(samples)."
def covariance(samples):
    d = samples - samples.mean(axis=0)
    return d.T @ d

# %% role="mistake" name="mean not subtracted" says="The means are not subtracted. First compute the deviations: samples - samples.mean(axis=0)."
def covariance(samples):
    return samples.T @ samples / len(samples)

# %% role="mistake" name="mean of the rows" says="You subtracted the mean of each row. The numbers of one kind stand in a column: mean(axis=0)."
def covariance(samples):
    d = samples - samples.mean(axis=1)[:, np.newaxis]
    return d.T @ d / len(samples)

# %% role="mistake" name="variances only" says="These are the variances alone. The covariances belong to the result too: the products of different columns, in an (n, n) matrix."
def covariance(samples):
    return samples.var(axis=0)

# %% role="mistake" name="variances on the diagonal" says="Beside the diagonal all numbers are 0 in your matrix. There belong the covariances: the means of the products of different columns."
def covariance(samples):
    return np.diag(samples.var(axis=0))

# %% role="mistake" name="absolute products" says="You took absolute values. A covariance keeps its sign: it is negative if one number falls when the other grows."
def covariance(samples):
    return np.abs(solution(samples))

# %% role="mistake" name="correlation" says="This is the correlation: the covariance divided by both standard deviations. The task asks for the covariance itself."
def covariance(samples):
    C = solution(samples)
    return C / np.sqrt(np.outer(np.diag(C), np.diag(C)))

# %% role="mistake" name="square root" says="You took the square root. The covariance matrix has the variances, not the standard deviations."
def covariance(samples):
    return np.sqrt(np.abs(solution(samples)))

# %% role="mistake" name="rounded" says="The numbers are rounded. Return the exact numbers, and leave round out."
def covariance(samples):
    return solution(samples).round(3)

# %% [markdown]
# # doubt-line

# %% role="mistake" name="weight 1 / sigma" says="Each point counts with 1 / sigma in your sum. The weight is 1 / sigma squared: divide the row by sigma itself, not by its root."
def fit_line(x, y, sigmas):
    return solution(x, y, np.sqrt(sigmas))

# %% role="mistake" name="y not divided" says="You divided the rows by sigma, but not y. Both sides belong together: y / sigmas."
def fit_line(x, y, sigmas):
    return solution(x, y * sigmas, sigmas)

# %% role="mistake" name="ones not divided" says="The column of ones is not divided by sigma. Divide the whole matrix: A / sigmas[:, np.newaxis]."
def fit_line(x, y, sigmas):
    A = np.column_stack([x / sigmas, np.ones(len(x))])
    return tuple(np.linalg.lstsq(A, y / sigmas)[0].tolist())

# %% role="mistake" name="only y divided" says="You divided y by sigma, but not the rows of the matrix. Both sides belong together: A / sigmas[:, np.newaxis]."
def fit_line(x, y, sigmas):
    return solution(x, y / sigmas, np.ones(len(x)))

# %% role="mistake" name="offset first" says="Slope and offset are exchanged: return the slope first."
def fit_line(x, y, sigmas):
    return solution(x, y, sigmas)[::-1]

# %% role="mistake" name="x and y exchanged" says="x and y are exchanged. The line gives y for each x: x belongs into the matrix, y to the other side."
def fit_line(x, y, sigmas):
    return solution(y, x, sigmas)

# %% role="mistake" name="no offset" says="Your line passes through 0: the column of ones is missing in the matrix. It stands for the offset."
def fit_line(x, y, sigmas):
    slope = (x * y / sigmas**2).sum() / (x * x / sigmas**2).sum()
    return float(slope), 0.0

# %% role="mistake" name="first and last point" says="This is the line through the first and the last point. Use all points: least squares."
def fit_line(x, y, sigmas):
    slope = (y[-1] - y[0]) / (x[-1] - x[0])
    return float(slope), float(y[0] - slope * x[0])

# %% role="mistake" name="minus slope" says="The slope has the wrong sign. It is positive if y grows with x."
def fit_line(x, y, sigmas):
    slope, offset = solution(x, y, sigmas)
    return -slope, offset

# %% role="mistake" name="rounded" says="The numbers are rounded. Return the exact numbers, and leave round out."
def fit_line(x, y, sigmas):
    slope, offset = solution(x, y, sigmas)
    return round(slope, 2), round(offset, 2)

# %% role="mistake" name="the offset afterwards" says="Your slope is that of a line through 0, and the offset comes afterwards. Compute both together: the matrix needs a column of ones."
def fit_line(x, y, sigmas):
    w = 1 / sigmas**2
    slope = (w * x * y).sum() / (w * x * x).sum()
    return float(slope), float((w * (y - slope * x)).sum() / w.sum())

# %% [markdown]
# # doubt-step

# %%
def any_step(x, ahead, aside, distances, sigmas, sign=-1, of_errors=2, of_slopes=2):
    """A step with other powers of sigma in its two sums, or in the other direction."""
    expected = np.hypot(ahead - x, aside)
    errors, J = expected - distances, -(ahead - x) / expected
    numerator = (J * errors / sigmas**of_errors).sum()
    return float(x + sign * numerator / (J * J / sigmas**of_slopes).sum())

# %% role="mistake" name="without the weights" says="sigmas are not used. With w = 1 / sigmas**2, each term of both sums is multiplied by its own w."
def place_step(x, ahead, aside, distances, sigmas):
    return solution(x, ahead, aside, distances, np.ones(len(ahead)))

# %% role="mistake" name="weights 1 / sigma" says="The weight is 1 / sigma squared, not 1 / sigma."
def place_step(x, ahead, aside, distances, sigmas):
    return solution(x, ahead, aside, distances, np.sqrt(sigmas))

# %% role="mistake" name="sigma as the weight" says="You multiplied by sigma squared, so uncertain measurements count most. The weight is 1 / sigmas**2."
def place_step(x, ahead, aside, distances, sigmas):
    return solution(x, ahead, aside, distances, 1 / sigmas)

# %% role="mistake" name="sigma squared missing" says="You multiplied by sigma, so uncertain measurements count most. The weight is 1 / sigmas**2."
def place_step(x, ahead, aside, distances, sigmas):
    return solution(x, ahead, aside, distances, 1 / np.sqrt(sigmas))

# %% role="mistake" name="weights below only" says="The weights are missing in the sum above the fraction line: sum(w * J * errors)."
def place_step(x, ahead, aside, distances, sigmas):
    return any_step(x, ahead, aside, distances, sigmas, of_errors=0)

# %% role="mistake" name="the step alone" says="This is the step alone. Add it to x: the function returns the new place."
def place_step(x, ahead, aside, distances, sigmas):
    return solution(x, ahead, aside, distances, sigmas) - x

# %% role="mistake" name="two steps" says="This is x after two steps. The task asks for one step."
def place_step(x, ahead, aside, distances, sigmas):
    return solution(solution(x, ahead, aside, distances, sigmas), ahead, aside, distances, sigmas)

# %% role="mistake" name="J at x = 0" says="J is computed at x = 0. Like the errors, it belongs to the guess: use ahead - x in place of ahead."
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead - x, aside) - distances
    J, w = -ahead / np.hypot(ahead, aside), 1 / sigmas**2
    return float(x - (w * J * errors).sum() / (w * J * J).sum())

# %% role="mistake" name="divided by the measured distances" says="J is divided by the measured distances. Divide by the computed ones, which x would give: J is -(ahead - x) / np.hypot(ahead - x, aside)."
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead - x, aside) - distances
    J, w = -(ahead - x) / distances, 1 / sigmas**2
    return float(x - (w * J * errors).sum() / (w * J * J).sum())

# %% role="mistake" name="J at x = 0, divided by the measured distances" says="J is computed at x = 0 and divided by the measured distances. It belongs to the guess: -(ahead - x) / np.hypot(ahead - x, aside)."
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead - x, aside) - distances
    J, w = -ahead / distances, 1 / sigmas**2
    return float(x - (w * J * errors).sum() / (w * J * J).sum())

# %% role="mistake" name="everything at x = 0" says="Errors and J are computed at x = 0, not at the guess. Use ahead - x in place of ahead."
def place_step(x, ahead, aside, distances, sigmas):
    return x + solution(0.0, ahead, aside, distances, sigmas)

# %% role="mistake" name="errors at x = 0" says="The errors are computed at x = 0, not at the guess. They are np.hypot(ahead - x, aside) - distances."
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead, aside) - distances
    J, w = -(ahead - x) / np.hypot(ahead - x, aside), 1 / sigmas**2
    return float(x - (w * J * errors).sum() / (w * J * J).sum())

# %% role="mistake" name="not divided" says="J is not divided by the distance: it is -(ahead - x) / np.hypot(ahead - x, aside), a number between -1 and 1."
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead - x, aside) - distances
    J, w = -(ahead - x), 1 / sigmas**2
    return float(x - (w * J * errors).sum() / (w * J * J).sum())

# %% role="mistake" name="ahead plus x" says="Seen from x, a thing is ahead - x in front of the camera, not ahead + x."
def place_step(x, ahead, aside, distances, sigmas):
    return -solution(-x, ahead, aside, distances, sigmas)

# %% role="mistake" name="mean of the steps" says="You computed a step for each look and took their mean. The step of least squares has two sums: sum(w * J * errors) / sum(w * J * J)."
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    return float(x - ((expected - distances) / (-(ahead - x) / expected)).mean())

# %% role="mistake" name="distances from 0" says="You compute the distances as if the place were 0. Compute them from x: np.hypot(ahead - x, aside)."
def place_step(x, ahead, aside, distances, sigmas):
    computed, w = np.hypot(ahead, aside), 1 / sigmas**2
    J = -(ahead - x) / computed
    return float(x - (w * J * (computed - distances)).sum() / (w * J * J).sum())

# %% role="mistake" name="the square of a sum" says="The lower sum adds up first, and is squared then. Square each J first: (w * J * J).sum()."
def place_step(x, ahead, aside, distances, sigmas):
    computed, w = np.hypot(ahead - x, aside), 1 / sigmas**2
    J = -(ahead - x) / computed
    return float(x - (w * J * (computed - distances)).sum() / (w * J).sum() ** 2)

# %% [markdown]
# # doubt-rotation

# %% role="mistake" name="transposed" says="This is the transposed matrix, the rotation in the other direction. Return U @ V."
def mean_rotation(rotations):
    return solution(rotations).T

# %% role="mistake" name="only the first" says="This is the first rotation. Take the mean of all of them: rotations.mean(axis=0)."
def mean_rotation(rotations):
    return rotations[0]

# %% role="mistake" name="the product" says="You multiplied the rotations, so all of them are made one after the other. Take their mean: rotations.mean(axis=0)."
def mean_rotation(rotations):
    product = rotations[0]
    for rotation in rotations[1:]:
        product = rotation @ product
    return product

# %% role="mistake" name="mean of the angles" says="This is the mean of the angles. Angles jump at pi: the mean of 3.0 and -3.0 is 0, the opposite direction. Take the mean of the matrices, and then the nearest rotation, U @ V."
def mean_rotation(rotations):
    angle = np.arctan2(rotations[:, 1, 0], rotations[:, 0, 0]).mean()
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])

# %% role="mistake" name="columns made 1 long" says="Your columns are 1 long, but they are not perpendicular to each other, or not the nearest ones. Use the SVD of the mean: U @ V."
def mean_rotation(rotations):
    mean = rotations.mean(axis=0)
    return mean / np.linalg.norm(mean, axis=0)

# %% role="mistake" name="divided by the determinant" says="You divided the mean by a number, but it is stretched in different ways along its axes. Use the SVD of the mean: U @ V."
def mean_rotation(rotations):
    mean = rotations.mean(axis=0)
    return mean / np.sqrt(np.abs(np.linalg.det(mean)))

# %% role="mistake" name="rounded" says="The numbers are rounded. Return the exact numbers, and leave round out."
def mean_rotation(rotations):
    return solution(rotations).round(2)

# %% role="mistake" name="the product, in their order" says="You multiply the rotations: that is one turn after the other. Take their mean, rotations.mean(axis=0), and its nearest rotation."
def mean_rotation(rotations):
    product = rotations[0]
    for rotation in rotations[1:]:
        product = product @ rotation
    return product
