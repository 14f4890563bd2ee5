# %% name="no minlength" sentence="An empty bin counts too: minlength=9." must_say=["empty bin|minlength"] kind="shape"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col)) % 180
    magnitudes = np.hypot(grad_row, grad_col)
    bins = (angles // 20).astype(int)
    return np.bincount(bins.ravel(), magnitudes.ravel()) / bins.size

# %% name="always 64 pixels" sentence="A cell has grad_row.size pixels, not always 64." must_say=["64|number of pixels", "size"] kind="value"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col)) % 180
    magnitudes = np.hypot(grad_row, grad_col)
    bins = (angles // 20).astype(int)
    histogram = np.zeros(9)
    for b, m in zip(bins.ravel(), magnitudes.ravel()):
        histogram[b] += m
    return histogram / 64

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    histogram = np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9) / grad_row.size

# %% name="divided by the width" sentence="Divide by the number of all pixels, not of the columns." must_say=["column|width", "all pixels"] must_not_say=["number of rows"] kind="value"
def cell_histogram(grad_row, grad_col):
    histogram = np.zeros(9)
    h, w = grad_row.shape
    for i in range(h):
        for j in range(w):
            angle = np.degrees(np.arctan2(grad_row[i, j], grad_col[i, j])) % 180
            histogram[int(angle // 20)] += np.hypot(grad_row[i, j], grad_col[i, j])
    return histogram / w
