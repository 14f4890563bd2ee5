# %% name="no minlength" sentence="An empty bin counts too: minlength=9." must_say=["empty bin|minlength"] kind="shape"
def cell_histogram(grad_row, grad_col):
    angles = np.degrees(np.arctan2(grad_row, grad_col)) % 180
    magnitudes = np.hypot(grad_row, grad_col)
    bins = (angles // 20).astype(int)
    return np.bincount(bins.ravel(), magnitudes.ravel()) / bins.size
