# %% name="only places" sentence="The angle is missing." must_say=["angle|three"] kind="shape"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1]])
