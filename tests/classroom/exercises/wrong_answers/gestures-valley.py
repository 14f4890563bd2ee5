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
