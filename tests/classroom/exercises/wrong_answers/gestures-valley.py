# %% name="range, from position 0" sentence="If start is larger than end, range is empty: count with % len(contour)." must_say=["% len|first one|empty"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, best_depth = 0, -1
    for i in range(start + 1, end):
        d = abs(turn(a, b, contour[i])) / length
        if d > best_depth:
            best, best_depth = i, d
    return best, best_depth

# %% name="start + 1 not wrapped" sentence="If start is the last position, start + 1 is too large: % len(contour)." must_say=["% len"] kind="error"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, best_depth = None, -1
    position = start + 1
    while position != end:
        d = abs(turn(a, b, contour[position])) / length
        if d > best_depth:
            best, best_depth = position, float(d)
        position = (position + 1) % len(contour)
    return best, best_depth

# %% name="only the depth" sentence="Return both, position and depth." must_say=["position"] kind="type"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.linalg.norm(b - a)
    depth = 0.0
    position = (start + 1) % len(contour)
    while position != end:
        depth = max(depth, float(abs(turn(a, b, contour[position])) / length))
        position = (position + 1) % len(contour)
    return depth

# %% name="position moves only if larger" sentence="Move on to the next position for every point, not only for a deeper one." must_say=["position|loop|time"] kind="too-slow"
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

# %% name="beginning of the contour first" sentence="Of equal points the first on the way from start counts." must_say=["first"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, best_depth = None, -1
    inside = [i for i in range(len(contour)) if (start < i < end if start < end else i > start or i < end)]
    for i in inside:
        d = abs(turn(a, b, contour[i])) / length
        if d > best_depth:
            best, best_depth = i, float(d)
    return best, best_depth
