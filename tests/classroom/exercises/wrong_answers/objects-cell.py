# %% name="counts" origin="new" sentence="Add the magnitude of each pixel, not 1." must_say=["magnitude"] kind="value"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col)) % 180
    histogram = np.zeros(9)
    for angle in angles.ravel():
        histogram[int(angle // 20)] += 1
    return histogram / grad_row.size

# %% name="arctan2 exchanged" origin="new" sentence="arctan2 takes the gradient along the rows first." must_say=["arctan2|exchanged"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_col, grad_row)) % 180 // 20).astype(int)
    return np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9) / grad_row.size

# %% name="no mean" origin="new" sentence="Divide by the number of pixels." must_say=["divide", "number of pixels|size"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    return np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9)

# %% name="L1" origin="new" sentence="The magnitude is the L2 norm." must_say=["L2"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    magnitudes = np.abs(grad_row) + np.abs(grad_col)
    return np.bincount(bins.ravel(), weights=magnitudes.ravel(), minlength=9) / grad_row.size

# %% name="no root" origin="new" sentence="Take the square root of the sum of squares." must_say=["root|hypot"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    magnitudes = grad_row ** 2 + grad_col ** 2
    return np.bincount(bins.ravel(), weights=magnitudes.ravel(), minlength=9) / grad_row.size

# %% name="radians" origin="new" sentence="The angles are in radians: make degrees of them." must_say=["radians|degrees"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.arctan2(grad_row, grad_col) % 180 // 20).astype(int)
    return np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9) / grad_row.size

# %% name="abs" origin="new" sentence="-30 degrees is the orientation 150, not 30: use % 180." must_say=["% 180"] kind="error"
def cell_histogram(grad_row, grad_col):
    bins = (np.abs(np.degrees(np.arctan2(grad_row, grad_col))) // 20).astype(int)
    histogram = np.zeros(9)
    for i, m in zip(bins.ravel(), np.hypot(grad_row, grad_col).ravel()):
        histogram[i] += m
    return histogram / grad_row.size

# %% name="no modulo" origin="new" sentence="Angles from -180 to 180 give negative bins: use % 180." must_say=["% 180|index|bin"] kind="error"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) // 20).astype(int)
    histogram = np.zeros(9)
    for i, m in zip(bins.ravel(), np.hypot(grad_row, grad_col).ravel()):
        histogram[i] += m
    return histogram / grad_row.size

# %% name="rounded" origin="new" sentence="Round down: // 20." must_say=["// 20"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = np.round(np.degrees(np.arctan2(grad_row, grad_col)) % 180 / 20).astype(int) % 9
    return np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9) / grad_row.size

# %% name="360 degrees" origin="new" sentence="An orientation is from 0 to 180 degrees." must_say=["180"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 360 // 40).astype(int)
    return np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9) / grad_row.size

# %% name="fancy index" origin="new" sentence="histogram[bins] += with an array counts each bin once: use a loop." must_say=["loop|bincount|once"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    histogram = np.zeros(9)
    histogram[bins] += np.hypot(grad_row, grad_col)
    return histogram / grad_row.size

# %% name="normalized to 1" origin="new" sentence="Divide by the number of pixels, not by the sum." must_say=["number of pixels"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    histogram = np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9)
    return histogram / histogram.sum()

# %% name="np.histogram of angles" origin="new" sentence="Each pixel adds its magnitude: weights=magnitudes." must_say=["magnitude"] kind="value"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col)) % 180
    counts, _ = np.histogram(angles, bins=9, range=(0, 180))
    return counts / grad_row.size

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    histogram = np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9) / grad_row.size

# %% name="int zeros" origin="new" sentence="The histogram of whole numbers cuts the magnitudes off: begin with np.zeros(9)." must_say=["float|whole numbers|zeros"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    histogram = np.zeros(9, int)
    for i, m in zip(bins.ravel(), np.hypot(grad_row, grad_col).ravel()):
        histogram[i] += int(m)
    return histogram / grad_row.size

# %% name="180 degrees" origin="walk" sentence="Exactly 180 degrees gets bin 9: use % 180 for all angles." must_say=["% 180", "bin 9|180 degrees"] must_not_say=["padded"] kind="error"
def cell_histogram(grad_row, grad_col):
    histogram = np.zeros(9)
    h, w = grad_row.shape
    for i in range(h):
        for j in range(w):
            angle = np.degrees(np.arctan2(grad_row[i, j], grad_col[i, j]))
            if angle < 0:
                angle = angle + 180
            histogram[int(angle // 20)] += np.hypot(grad_row[i, j], grad_col[i, j])
    return histogram / (h * w)

# %% name="no minlength" origin="walk" sentence="An empty bin counts too: minlength=9." must_say=["empty bin|minlength"] kind="shape"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col)) % 180
    magnitudes = np.hypot(grad_row, grad_col)
    bins = (angles // 20).astype(int)
    return np.bincount(bins.ravel(), magnitudes.ravel()) / bins.size

# %% name="always 64 pixels" origin="walk" sentence="A cell has grad_row.size pixels, not always 64." must_say=["64|number of pixels", "size"] kind="value"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col)) % 180
    magnitudes = np.hypot(grad_row, grad_col)
    bins = (angles // 20).astype(int)
    histogram = np.zeros(9)
    for b, m in zip(bins.ravel(), magnitudes.ravel()):
        histogram[b] += m
    return histogram / 64

# %% name="divided by the width" origin="walk" sentence="Divide by the number of all pixels, not of the columns." must_say=["column|width", "all pixels"] must_not_say=["number of rows"] kind="value"
def cell_histogram(grad_row, grad_col):
    histogram = np.zeros(9)
    h, w = grad_row.shape
    for i in range(h):
        for j in range(w):
            angle = np.degrees(np.arctan2(grad_row[i, j], grad_col[i, j])) % 180
            histogram[int(angle // 20)] += np.hypot(grad_row[i, j], grad_col[i, j])
    return histogram / w

# %% name="a row of bins at once" origin="walk" sentence="A row of bins counts each bin once: add pixel by pixel." must_say=["once", "pixel by pixel|ravel|loop"] kind="value"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col)) % 180
    magnitudes = np.hypot(grad_row, grad_col)
    bins = (angles // 20).astype(int)
    histogram = np.zeros(9)
    for i in range(len(bins)):
        histogram[bins[i]] += magnitudes[i]
    return histogram / bins.size

# %% name="float bins" origin="walk" sentence="// of floats gives a float: make whole numbers with astype(int)." must_say=["astype\\(int\\)|int\\(", "float"] must_not_say=["^Divide with //,"] kind="error"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col)) % 180
    magnitudes = np.hypot(grad_row, grad_col)
    bins = angles // 20
    histogram = np.zeros(9)
    for b, m in zip(bins.ravel(), magnitudes.ravel()):
        histogram[b] += m
    return histogram / bins.size
