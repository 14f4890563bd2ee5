# %% name="only the depth" origin="fresh" sentence="Return both, position and depth." must_say=["position"] kind="type"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.linalg.norm(b - a)
    depth = 0.0
    position = (start + 1) % len(contour)
    while position != end:
        depth = max(depth, float(abs(turn(a, b, contour[position])) / length))
        position = (position + 1) % len(contour)
    return depth

# %% name="position moves only if larger" origin="fresh" sentence="Move on to the next position for every point, not only for a deeper one." must_say=["position|loop|time"] kind="too-slow"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.linalg.norm(b - a)
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = float(abs(turn(a, b, contour[position])) / length)
        if distance > depth:
            best, depth = position, distance
            position = (position + 1) % len(contour)
    return best, depth

# %% name="best not kept" origin="fresh" sentence="The depth must be kept together with the position." must_say=["depth|keep|last"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.linalg.norm(b - a)
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = float(abs(turn(a, b, contour[position])) / length)
        if distance > depth:
            best = position
        position = (position + 1) % len(contour)
    return best, distance

# %% name="distance to the middle" origin="fresh" sentence="Measure the distance to the line, not to the middle." must_say=["line"] kind="value"
def deepest_point(contour, start, end):
    middle = (contour[start] + contour[end]) / 2
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = float(np.linalg.norm(contour[position] - middle))
        if distance > depth:
            best, depth = position, distance
        position = (position + 1) % len(contour)
    return best, depth

# %% name="vertical distance" origin="fresh" sentence="Divide by the length of the line, not by its width." must_say=["length|line"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = float(abs(turn(a, b, contour[position])) / abs(b[0] - a[0]))
        if distance > depth:
            best, depth = position, distance
        position = (position + 1) % len(contour)
    return best, depth
