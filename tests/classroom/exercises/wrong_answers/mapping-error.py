# %% name="not wrapped" origin="new" sentence="Wrap the angle with math.remainder." must_say=["wrap|remainder"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], second[2] - first[2] - measured[2]])

# %% name="wrapped too early" origin="new" sentence="Wrap at the end, after the measured angle is subtracted." must_say=["wrap"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    turn = math.remainder(second[2] - first[2], 2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], turn - measured[2]])

# %% name="% of a full turn" origin="new" sentence="% never gives negative angles: use math.remainder." must_say=["remainder"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    turn = (second[2] - first[2] - measured[2]) % (2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], turn])

# %% name="not turned" origin="new" sentence="Turn dx and dy by the first yaw." must_say=["turn|first pose|c \\*"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    turn = math.remainder(second[2] - first[2] - measured[2], 2 * math.pi)
    return np.array([dx - measured[0], dy - measured[1], turn])

# %% name="wrong side" origin="new" sentence="A sign of s is wrong." must_say=["sign|side"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    turn = math.remainder(second[2] - first[2] - measured[2], 2 * math.pi)
    return np.array([c * dx - s * dy - measured[0], s * dx + c * dy - measured[1], turn])

# %% name="second yaw" origin="new" sentence="Use the yaw of the first pose." must_say=["first"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(second[2]), math.sin(second[2])
    turn = math.remainder(second[2] - first[2] - measured[2], 2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], turn])

# %% name="sine and cosine" origin="new" sentence="c is the cosine, s the sine." must_say=["cosine"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    s, c = math.cos(first[2]), math.sin(first[2])
    turn = math.remainder(second[2] - first[2] - measured[2], 2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], turn])

# %% name="measured minus poses" origin="new" sentence="The error is what the poses say less what was measured." must_say=["sign|less"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    turn = math.remainder(measured[2] - (second[2] - first[2]), 2 * math.pi)
    return np.array([measured[0] - (c * dx + s * dy), measured[1] - (c * dy - s * dx), turn])

# %% name="nothing subtracted" origin="new" sentence="Subtract the measured motion." must_say=["subtract"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    return np.array([c * dx + s * dy, c * dy - s * dx, math.remainder(second[2] - first[2], 2 * math.pi)])

# %% name="measured angle forgotten" origin="new" sentence="Subtract the measured angle as well." must_say=["angle"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    turn = math.remainder(second[2] - first[2], 2 * math.pi)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], turn])

# %% name="only places" origin="new" sentence="The angle is missing." must_say=["angle|three"] kind="shape"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1]])

# %% name="sum of squares" origin="new" sentence="Return three numbers, not their sum of squares." must_say=["three|one number"] kind="shape"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    turn = math.remainder(second[2] - first[2] - measured[2], 2 * math.pi)
    return (c * dx + s * dy - measured[0]) ** 2 + (c * dy - s * dx - measured[1]) ** 2 + turn**2

# %% name="360" origin="new" sentence="The angles are radians: 2 * math.pi, not 360." must_say=["2 \\* math.pi|radian|wrap"] kind="value"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    turn = math.remainder(second[2] - first[2] - measured[2], 360)
    return np.array([c * dx + s * dy - measured[0], c * dy - s * dx - measured[1], turn])
