# %% name="ends only" sentence="The cells on the way are free: add the log-odds of passed." must_say=["way|passed"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)
