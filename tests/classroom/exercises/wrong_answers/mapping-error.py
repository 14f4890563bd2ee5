# %% name="not wrapped" sentence="Wrap the angle with math.remainder." must_say=["wrap|remainder"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], second[2] - first[2] - measured[2]])

# %% name="only places" sentence="The angle is missing." must_say=["angle|three"] kind="shape"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1]])

# %% name="atan2 forgotten, pi added" sentence="Bring the angle between -pi and pi with math.remainder." must_say=["remainder|wrap"] kind="value"
def edge_error(first, second, measured):
    c, s = math.cos(first[2]), math.sin(first[2])
    dx, dy = second[0] - first[0], second[1] - first[1]
    angle = (second[2] - first[2] - measured[2] + math.pi) % (2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], angle])

# %% name="wrapped too early" sentence="Wrap at the end, after the measured angle is subtracted." must_say=["wrap"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    turn = math.remainder(second[2] - first[2], 2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], turn - measured[2]])

# %% name="wrong side" sentence="A sign of s is wrong." must_say=["sign|side"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    turn = math.remainder(second[2] - first[2] - measured[2], 2 * math.pi)
    return np.array([c * dx - s * dy - measured[0], s * dx + c * dy - measured[1], turn])
