# %% name="abs of the angle" origin="fresh" sentence="The sign of the angle counts." must_say=["sign|negative"] kind="value"
def edge_error(first, second, measured):
    c, s = math.cos(first[2]), math.sin(first[2])
    dx, dy = second[0] - first[0], second[1] - first[1]
    angle = abs(math.remainder(second[2] - first[2] - measured[2], 2 * math.pi))
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], angle])

# %% name="left negative" origin="fresh" sentence="The sign of left is wrong." must_say=["left|sign"] kind="value"
def edge_error(first, second, measured):
    c, s = math.cos(first[2]), math.sin(first[2])
    dx, dy = second[0] - first[0], second[1] - first[1]
    angle = math.remainder(second[2] - first[2] - measured[2], 2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], s * dx - c * dy - measured[1], angle])

# %% name="plus measured" origin="fresh" sentence="Subtract the measured motion." must_say=["subtract"] kind="value"
def edge_error(first, second, measured):
    c, s = math.cos(first[2]), math.sin(first[2])
    dx, dy = second[0] - first[0], second[1] - first[1]
    angle = math.remainder(second[2] - first[2] + measured[2], 2 * math.pi)
    return np.array([c * dx + s * dy + measured[0], c * dy - s * dx + measured[1], angle])

# %% name="first less second" origin="fresh" sentence="dx and dy are second minus first." must_say=["second minus first|sign"] kind="value"
def edge_error(first, second, measured):
    c, s = math.cos(first[2]), math.sin(first[2])
    dx, dy = first[0] - second[0], first[1] - second[1]
    angle = math.remainder(first[2] - second[2] - measured[2], 2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], angle])

# %% name="atan2 forgotten, pi added" origin="fresh" sentence="Bring the angle between -pi and pi with math.remainder." must_say=["remainder|wrap"] kind="value"
def edge_error(first, second, measured):
    c, s = math.cos(first[2]), math.sin(first[2])
    dx, dy = second[0] - first[0], second[1] - first[1]
    angle = (second[2] - first[2] - measured[2] + math.pi) % (2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], angle])
