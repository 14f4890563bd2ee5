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

# %% role="mistake" name="bins from the smallest angle" says="Your bins go from the smallest to the largest angle. They go from 0 to 180: np.histogram needs range=(0, 180)."
def cell_histogram(grad_row, grad_col):
    angles, weights = orientations(grad_row, grad_col), np.hypot(grad_row, grad_col)
    return np.histogram(angles, bins=9, weights=weights)[0] / angles.size

# %% role="mistake" name="L1 norm" says="You added the L1 norm, |grad_row| + |grad_col|. The magnitude is the L2 norm here: np.hypot(grad_row, grad_col)."
def cell_histogram(grad_row, grad_col):
    return histogram_of(orientations(grad_row, grad_col), abs(grad_row) + abs(grad_col))

# %% role="mistake" name="absolute angle" says="Your negative angles lose their sign, as with abs, so -30 becomes 30. Its orientation is 150: use % 180."
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

# %% role="mistake" name="bins of 40 degrees" says="Your bins have 40 degrees. Orientations end at 180, and 180 / 9 is 20: use // 20."
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

# %% role="mistake" name="largest magnitude" says="Each of your bins has only the largest magnitude of its pixels. Add all of them, pixel by pixel, with +=."
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

# %% role="mistake" name="backwards" says="Your bins are in the opposite order: the rows count downwards here, so do not change the sign of a gradient or angle."
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

# %% role="mistake" name="divided by the number of all" says="You divided each sum by the number of all vectors. The mean of a class divides by the number of its own vectors."
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    return nearest(numbers, np.array([vectors[classes == number].sum(axis=0) / len(vectors) for number in numbers]), new)

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

# %% role="mistake" name="in the order of first appearance" says="The means and the classes are in different orders: one as they come, the other as in np.unique. Use the same list for both."
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
