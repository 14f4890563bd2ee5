# %% name="arctan of the quotient" origin="fresh" sentence="The quotient divides by 0: use arctan2." must_say=["arctan2|nan|divi"] kind="error"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan(grad_row / grad_col)) % 180
    bins = (angles // 20).astype(int)
    return np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9) / grad_row.size

# %% name="only the column gradient" origin="fresh" sentence="The magnitude contains both gradients: np.hypot(grad_row, grad_col)." must_say=["magnitude|hypot|L2"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    return np.bincount(bins.ravel(), weights=np.abs(grad_col).ravel(), minlength=9) / grad_row.size

# %% name="divided by 64" origin="fresh" sentence="Divide by the number of pixels of this cell: grad_row.size." must_say=["grad_row\\.size|number of"] kind="value"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 20).astype(int)
    return np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=9) / 64

# %% name="plus 180" origin="fresh" sentence="Angles from 0 to 360 are too many: use % 180." must_say=["% 180|180"] kind="error"
def cell_histogram(grad_row, grad_col):
    bins = ((np.degrees(np.arctan2(grad_row, grad_col)) + 180) // 20).astype(int)
    histogram = np.zeros(9)
    for i, m in zip(bins.ravel(), np.hypot(grad_row, grad_col).ravel()):
        histogram[i] += m
    return histogram / grad_row.size

# %% name="ten bins" origin="fresh" sentence="Nine bins of 20 degrees." must_say=["nine|20 degrees|9"] kind="shape"
def cell_histogram(grad_row, grad_col):
    bins = (np.degrees(np.arctan2(grad_row, grad_col)) % 180 // 18).astype(int)
    return np.bincount(bins.ravel(), weights=np.hypot(grad_row, grad_col).ravel(), minlength=10) / grad_row.size
