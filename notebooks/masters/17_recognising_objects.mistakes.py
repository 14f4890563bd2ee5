# %% [markdown]
# # objects-cell

# %%
def folded(degrees, period=180.0):
    return degrees % period

def orientations(grad_row, grad_col):
    return folded(np.degrees(np.arctan2(grad_row, grad_col)))

def histogram_of(angles, magnitudes, width=20.0, count=9):
    bins = np.floor(angles / width).astype(int) % count
    return np.bincount(bins.ravel(), weights=magnitudes.ravel(), minlength=count) / angles.size

# %% role="mistake" name="L1 norm" says="You added the L1 norm, |grad_row| + |grad_col|. The magnitude is the L2 norm here: np.hypot(grad_row, grad_col)."
def cell_histogram(grad_row, grad_col):
    return histogram_of(orientations(grad_row, grad_col), abs(grad_row) + abs(grad_col))

# %% role="mistake" name="absolute angle" says="You took the absolute value of the angle, so -30 became 30. Its orientation is 150: use % 180."
def cell_histogram(grad_row, grad_col):
    angles = abs(np.degrees(np.arctan2(grad_row, grad_col))) % 180
    return histogram_of(angles, np.hypot(grad_row, grad_col))

# %% role="mistake" name="absolute angle, 180 degrees" says="An angle of exactly 180 degrees gets bin 9, which does not exist. And the absolute value of -30 is 30, but its orientation is 150. Use % 180 for all angles."
def cell_histogram(grad_row, grad_col):
    bins = (abs(np.degrees(np.arctan2(grad_row, grad_col))) // 20).astype(int)
    histogram = np.zeros(9)
    for i, magnitude in zip(bins.ravel(), np.hypot(grad_row, grad_col).ravel(), strict=True):
        histogram[i] += magnitude
    return histogram / grad_row.size

# %% role="mistake" name="180 degrees" says="An angle of exactly 180 degrees gets bin 9, which does not exist. Its orientation is 0: use % 180 for all angles."
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) // 20).astype(int)
    histogram = np.zeros(9)
    for i, magnitude in zip(bins.ravel(), np.hypot(grad_row, grad_col).ravel(), strict=True):
        histogram[i] += magnitude
    return histogram / grad_row.size

# %% role="mistake" name="negative angles left out" says="Pixels with a negative angle are missing. Bring all angles into 0 to 180 with % 180."
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col))
    return histogram_of(np.abs(angles), np.where((angles >= 0) & (angles < 180), np.hypot(grad_row, grad_col), 0.0))

# %% role="mistake" name="eight bins" says="You have eight bins. Nine bins of 20 degrees make 180."
def cell_histogram(grad_row, grad_col):
    return histogram_of(orientations(grad_row, grad_col), np.hypot(grad_row, grad_col), 22.5, 8)

# %% role="mistake" name="bins of 22.5 degrees" says="Your bins have 22.5 degrees, so the last one stays empty. Nine bins have 20 degrees each: // 20."
def cell_histogram(grad_row, grad_col):
    return histogram_of(orientations(grad_row, grad_col), np.hypot(grad_row, grad_col), 22.5, 9)

# %% role="mistake" name="bins of 10 degrees" says="Your bins do not have 20 degrees: 180 degrees divided by nine bins is 20."
def cell_histogram(grad_row, grad_col):
    return histogram_of(orientations(grad_row, grad_col) / 2, np.hypot(grad_row, grad_col))

# %% role="mistake" name="mean of each bin" says="You divided each bin by the number of its own pixels. Divide all by the number of pixels of the whole cell."
def cell_histogram(grad_row, grad_col):
    counts = np.round(histogram_of(orientations(grad_row, grad_col), np.ones_like(grad_row)) * grad_row.size)
    return solution(grad_row, grad_col) * grad_row.size / np.maximum(counts, 1)

# %% role="mistake" name="length 1" says="You divided by the L2 norm of the histogram. Divide by the number of pixels: the light is removed later, for a whole block."
def cell_histogram(grad_row, grad_col):
    histogram = solution(grad_row, grad_col)
    return histogram / np.sqrt((histogram * histogram).sum())

# %% role="mistake" name="whole magnitudes" says="Your magnitudes are cut to whole numbers. Begin with np.zeros(9), which has floats, and add the magnitude itself."
def cell_histogram(grad_row, grad_col):
    return histogram_of(orientations(grad_row, grad_col), np.floor(np.hypot(grad_row, grad_col)))

# %% role="mistake" name="largest magnitude" says="Each of your bins has the largest magnitude of its pixels, or the last one: you write with =. Add them with +=."
def cell_histogram(grad_row, grad_col):
    bins, magnitudes = (orientations(grad_row, grad_col) // 20).astype(int).ravel(), np.hypot(grad_row, grad_col).ravel()
    return np.array([magnitudes[bins == i].max(initial=0.0) for i in range(9)]) / grad_row.size

# %% role="mistake" name="last magnitude" says="Each of your bins has only the magnitude of its last pixel. histogram[i] = ... overwrites; histogram[bins] += ... with an array of bins also counts each bin once. Add pixel by pixel in a loop, or use np.bincount."
def cell_histogram(grad_row, grad_col):
    histogram = np.zeros(9)
    histogram[(orientations(grad_row, grad_col) // 20).astype(int).ravel()] = np.hypot(grad_row, grad_col).ravel()
    return histogram / grad_row.size

# %% role="mistake" name="divided by the rows" says="You divided by the number of rows. Divide by the number of all pixels: grad_row.size."
def cell_histogram(grad_row, grad_col):
    return solution(grad_row, grad_col) * grad_row.size / len(grad_row)

# %% role="mistake" name="divided by the columns" says="You divided by the number of columns. Divide by the number of all pixels: grad_row.size."
def cell_histogram(grad_row, grad_col):
    return solution(grad_row, grad_col) * grad_row.size / grad_row.shape[1]

# %% role="mistake" name="divided by 64" says="You divided by 64. Not every cell has 8 × 8 pixels here: divide by grad_row.size."
def cell_histogram(grad_row, grad_col):
    return solution(grad_row, grad_col) * grad_row.size / 64

# %% role="mistake" name="empty bins missing" says="An empty bin counts too: the histogram always has nine numbers (np.bincount needs minlength=9)."
def cell_histogram(grad_row, grad_col):
    return np.trim_zeros(solution(grad_row, grad_col), "b")

# %% role="mistake" name="rows of bins" says="You add a whole row of magnitudes to a row of bins, and then each bin counts only once in a row. Add pixel by pixel: go through bins.ravel() and magnitudes.ravel() together."
def cell_histogram(grad_row, grad_col):
    histogram = np.zeros(9)
    bins = (orientations(grad_row, grad_col) // 20).astype(int)
    for i, magnitudes in zip(bins, np.hypot(grad_row, grad_col), strict=True):
        histogram[i] += magnitudes
    return histogram / grad_row.size

# %% role="mistake" name="divided by nine" says="You divided by the number of bins. Divide by the number of pixels of the cell: grad_row.size."
def cell_histogram(grad_row, grad_col):
    return solution(grad_row, grad_col) * grad_row.size / 9

# %% role="mistake" name="the largest bin" says="You return only the number of the largest bin. Return the whole histogram, nine numbers."
def cell_histogram(grad_row, grad_col):
    return int(solution(grad_row, grad_col).argmax())

# %% role="mistake" name="backwards" says="Your bins are in the opposite order: the rows count downwards here, so do not change the sign of a gradient."
def cell_histogram(grad_row, grad_col):
    return solution(-grad_row, grad_col)

# %% role="mistake" name="bins moved" says="Your bins are moved by one: bin 0 is from 0 up to 20 degrees. Use the orientation // 20, without + 1 or - 1."
def cell_histogram(grad_row, grad_col):
    return np.roll(solution(grad_row, grad_col), 1)

# %% role="mistake" name="zeros" says="Your histogram is full of zeros. Does the loop add the magnitudes to it?"
def cell_histogram(grad_row, grad_col):
    return np.zeros(9)

# %% [markdown]
# # objects-mean

# %%
def nearest(numbers, means, new, power=2):
    return numbers[(abs(new[:, None] - means) ** power).sum(axis=2).argmin(axis=1)]

# %% role="mistake" name="classes that do not occur" says="A class that does not occur has the mean nan, and argmin takes it. Compute means only for the numbers in np.unique(classes)."
def nearest_mean(vectors, classes, new):
    numbers = np.arange(classes.max() + 1)
    return nearest(numbers, np.array([vectors[classes == number].mean(axis=0) for number in numbers]), new)

# %% role="mistake" name="best distance and class kept" says="The best distance and its class are kept from one new vector to the next. Begin with a large distance again for each new vector."
def nearest_mean(vectors, classes, new):
    numbers, means = means_of(vectors, classes)
    best, result = np.inf, []
    for distances in ((new[:, None] - means) ** 2).sum(axis=2):
        if distances.min() < best:
            best, number = distances.min(), numbers[distances.argmin()]
        result.append(number)
    return np.array(result)

# %% role="mistake" name="absolute differences" says="You added the absolute differences. The Euclidean distance adds their squares."
def nearest_mean(vectors, classes, new):
    return nearest(*means_of(vectors, classes), new, power=1)

# %% role="mistake" name="differences without squares" says="You added the differences with their signs, so they cancel out. Square them first."
def nearest_mean(vectors, classes, new):
    numbers, means = means_of(vectors, classes)
    return numbers[(new[:, None] - means).sum(axis=2).argmin(axis=1)]

# %% role="mistake" name="largest difference" says="You compare the largest difference only. The Euclidean distance adds the squares of all differences."
def nearest_mean(vectors, classes, new):
    numbers, means = means_of(vectors, classes)
    return numbers[abs(new[:, None] - means).max(axis=2).argmin(axis=1)]

# %% role="mistake" name="first number only" says="You compare only the first number of each vector. Add the squares of all differences: .sum(axis=2)."
def nearest_mean(vectors, classes, new):
    numbers, means = means_of(vectors, classes)
    return nearest(numbers, means[:, :1], new[:, :1])

# %% role="mistake" name="one number for each class" says="The mean of a class is one number, or you compare one number alone. Has each mean as many numbers as a vector, .mean(axis=0)? And do you square the differences before you add them?"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == number].mean() for number in numbers])
    return nearest(numbers, means[:, None], new.mean(axis=1)[:, None])

# %% role="mistake" name="last vector of a class" says="You compare with the last vector of each class. Take the mean of all its vectors."
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    return nearest(numbers, np.array([vectors[classes == number][-1] for number in numbers]), new)

# %% role="mistake" name="one new vector" says="You return the class of the first new vector only. Return one class for each new vector."
def nearest_mean(vectors, classes, new):
    return solution(vectors, classes, new)[:1]

# %% role="mistake" name="in the order of first appearance" says="The means and the classes are in a different order: you list the classes as they come, but take the means in the order of np.unique. Use the same list for both."
def nearest_mean(vectors, classes, new):
    _, means = means_of(vectors, classes)
    return nearest(np.array(list(dict.fromkeys(classes.tolist()))), means, new)

# %% role="mistake" name="the last class left out" says="One class is never found: the last one. Take all numbers of np.unique(classes)."
def nearest_mean(vectors, classes, new):
    numbers, means = means_of(vectors, classes)
    return nearest(numbers[:-1], means[:-1], new)

# %% role="mistake" name="the first class left out" says="One class is never found: the first one. Take all numbers of np.unique(classes)."
def nearest_mean(vectors, classes, new):
    numbers, means = means_of(vectors, classes)
    return nearest(numbers[1:], means[1:], new)

# %% role="mistake" name="all distances" says="You return all distances. Take the position of the smallest one in each row, and the class at this position."
def nearest_mean(vectors, classes, new):
    _, means = means_of(vectors, classes)
    return np.sqrt(((new[:, None] - means) ** 2).sum(axis=2))

# %% role="mistake" name="means" says="You return the means. Return the class of each new vector."
def nearest_mean(vectors, classes, new):
    return means_of(vectors, classes)[1]

# %% role="mistake" name="argmin over the new vectors" says="argmin went over the new vectors. Take the smallest distance of each new vector: with distances of shape (M, classes) this is argmin(axis=1)."
def nearest_mean(vectors, classes, new):
    _, means = means_of(vectors, classes)
    return ((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=0)

# %% [markdown]
# # objects-inliers

# %%
def masks_of(points, pixels, samples, near):
    return np.array([near(homography(points[s], pixels[s]), points, pixels) for s in samples])

def distance(H, points, pixels):
    return np.linalg.norm(moved_by(H, points) - pixels, axis=1)

def most(masks):
    return masks[np.argmax(masks.sum(axis=1))]

# %% role="mistake" name="the fewest" says="You kept the sample with the fewest inliers. Keep the one with the most."
def find_inliers(points, pixels, samples, limit):
    masks = masks_of(points, pixels, samples, lambda H, a, b: distance(H, a, b) < limit)
    return masks[np.argmin(masks.sum(axis=1))]

# %% role="mistake" name="the last sample" says="You return the inliers of the last sample. Keep those of the sample with the most. (Do you write each sample into the same array? Then best is only another name for it.)"
def find_inliers(points, pixels, samples, limit):
    return distance(homography(points[samples[-1]], pixels[samples[-1]]), points, pixels) < limit

# %% role="mistake" name="the first sample" says="You return the inliers of the first sample. Is return inside the loop? Or do you count with len(near)? near.sum() counts the inliers."
def find_inliers(points, pixels, samples, limit):
    return distance(homography(points[samples[0]], pixels[samples[0]]), points, pixels) < limit

# %% role="mistake" name="squared distance" says="You compare the squared distance with the limit. Take its square root, or compare with limit ** 2."
def find_inliers(points, pixels, samples, limit):
    return most(masks_of(points, pixels, samples, lambda H, a, b: distance(H, a, b) ** 2 < limit))

# %% role="mistake" name="first coordinate only" says="You compare only the first coordinate. The distance contains both: np.linalg.norm(..., axis=1)."
def find_inliers(points, pixels, samples, limit):
    return most(masks_of(points, pixels, samples, lambda H, a, b: abs(moved_by(H, a) - b)[:, 0] < limit))

# %% role="mistake" name="second coordinate only" says="You compare only the second coordinate. The distance contains both: np.linalg.norm(..., axis=1)."
def find_inliers(points, pixels, samples, limit):
    return most(masks_of(points, pixels, samples, lambda H, a, b: abs(moved_by(H, a) - b)[:, 1] < limit))

# %% role="mistake" name="back to the plate" says="You moved the pixels back to the points, so your distances are not in pixels of the frame. Move the points: homography(points[sample], pixels[sample])."
def find_inliers(points, pixels, samples, limit):
    return most(masks_of(points, pixels, samples, lambda H, a, b: distance(np.linalg.inv(H), b, a) < limit))

# %% role="mistake" name="pixels moved" says="You moved the pixels. Move the points, and compare them with the pixels."
def find_inliers(points, pixels, samples, limit):
    return most(masks_of(points, pixels, samples, lambda H, a, b: distance(H, b, a) < limit))

# %% role="mistake" name="one homography of all" says="Your mask is False everywhere, or nearly. Print the distances: is there one for each match (axis=1)? Is the homography computed from the four matches of the sample, and not from all? And do you keep the mask with the most inliers (near.sum(), not len)?"
def find_inliers(points, pixels, samples, limit):
    return distance(homography(points, pixels), points, pixels) < limit

# %% role="mistake" name="all samples together" says="You joined the inliers of all samples. Return those of the best sample only."
def find_inliers(points, pixels, samples, limit):
    return masks_of(points, pixels, samples, lambda H, a, b: distance(H, a, b) < limit).any(axis=0)

# %% role="mistake" name="only the sample" says="You return only the four matches of the sample. All matches that are near count as inliers."
def find_inliers(points, pixels, samples, limit):
    masks = masks_of(points, pixels, samples, lambda H, a, b: distance(H, a, b) < limit)
    return np.isin(np.arange(len(points)), samples[np.argmax(masks.sum(axis=1))])

# %% role="mistake" name="how many" says="You return how many inliers there are. Return the mask: True or False for each match."
def find_inliers(points, pixels, samples, limit):
    return int(solution(points, pixels, samples, limit).sum())

# %% role="mistake" name="computed again" says="You computed the homography again, from all inliers of the best sample. On a robot this is good, but here return the inliers of the sample's own homography."
def find_inliers(points, pixels, samples, limit):
    best = solution(points, pixels, samples, limit)
    return distance(homography(points[best], pixels[best]), points, pixels) < limit

# %% role="mistake" name="four points moved" says="You moved only the four matches of the sample. Move all points, and compare all of them."
def find_inliers(points, pixels, samples, limit):
    return np.ones(4, bool)

# %% role="mistake" name="smallest sum of distances" says="You keep the sample with the smallest sum of distances, and one far match can change it. Keep the one with the most inliers."
def find_inliers(points, pixels, samples, limit):
    distances = masks_of(points, pixels, samples, distance)
    return distances[np.argmin(distances.sum(axis=1))] < limit

# %% role="mistake" name="half the limit" says="Some matches are missing: compare the distance with the limit itself."
def find_inliers(points, pixels, samples, limit):
    return most(masks_of(points, pixels, samples, lambda H, a, b: distance(H, a, b) < limit / 2))

# %% role="mistake" name="more than the four" says="You begin with a count of 4, so a sample of which only its own four match is never kept. Begin with 0."
def find_inliers(points, pixels, samples, limit):
    best = solution(points, pixels, samples, limit)
    return best & (best.sum() > 4)
