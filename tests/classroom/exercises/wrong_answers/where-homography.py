# %% name="affine" sentence="The last row is not 0, 0, 1: far things must look smaller." must_say=["last row|perspective|far"] kind="value"
def find_homography(points, pixels):
    A = np.column_stack([points, np.ones(4)])
    columns = np.linalg.lstsq(A, pixels)[0]
    return np.vstack([columns.T, [0, 0, 1]])
