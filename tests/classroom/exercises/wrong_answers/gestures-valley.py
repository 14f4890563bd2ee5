# %% name="area" origin="new" sentence="Divide by the length of the line: turn is an area." must_say=["divide", "length"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    best, depth = start, -1
    position = (start + 1) % len(contour)
    while position != end:
        distance = abs(turn(a, b, contour[position]))
        if distance > depth:
            best, depth = position, float(distance)
        position = (position + 1) % len(contour)
    return best, depth

# %% name="sign" origin="new" sentence="turn can be negative: take abs." must_say=["sign|negative|abs"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = turn(a, b, contour[position]) / length
        if distance > depth:
            best, depth = position, float(distance)
        position = (position + 1) % len(contour)
    return best, depth

# %% name="sign, from 0" origin="new" sentence="turn can be negative: take abs." must_say=["sign|negative|abs"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, 0.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = turn(a, b, contour[position]) / length
        if distance > depth:
            best, depth = position, float(distance)
        position = (position + 1) % len(contour)
    return best, depth

# %% name="last of equals" origin="new" sentence="Of equally far points the first counts: use >." must_say=["first", ">"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = abs(turn(a, b, contour[position])) / length
        if distance >= depth:
            best, depth = position, float(distance)
        position = (position + 1) % len(contour)
    return best, depth

# %% name="range" origin="new" sentence="If start is larger than end, range is empty: count with % len(contour)." must_say=["% len|first one|empty"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, -1.0
    for position in range(start + 1, end):
        distance = abs(turn(a, b, contour[position])) / length
        if distance > depth:
            best, depth = position, float(distance)
    return best, depth

# %% name="range, from 0" origin="new" sentence="If start is larger than end, range is empty: count with % len(contour)." must_say=["% len|first one|empty"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, 0.0
    for position in range(start + 1, end):
        distance = abs(turn(a, b, contour[position])) / length
        if distance > depth:
            best, depth = position, float(distance)
    return best, depth

# %% name="no remainder" origin="new" sentence="After the last point comes the first one: % len(contour)." must_say=["% len|first one|remainder|too slow|out of bounds"] kind="error"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, -1.0
    position = start + 1
    while position != end:
        distance = abs(turn(a, b, contour[position])) / length
        if distance > depth:
            best, depth = position, float(distance)
        position += 1
    return best, depth

# %% name="min and max of the positions" origin="new" sentence="If start is larger than end you look at the other points: go on over the end." must_say=["over the end|other points|first one"] kind="value"
def deepest_point(contour, start, end):
    start, end = min(start, end), max(start, end)
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, -1.0
    for position in range(start + 1, end):
        distance = abs(turn(a, b, contour[position])) / length
        if distance > depth:
            best, depth = position, float(distance)
    return best, depth

# %% name="all points" origin="new" sentence="Look only at the points after start and before end." must_say=["after start", "before end"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    distances = [abs(turn(a, b, p)) / length for p in contour]
    best = int(np.argmax(distances))
    return best, float(distances[best])

# %% name="position in the valley" origin="new" sentence="Return the position in the contour, not the one in the valley." must_say=["position in the contour"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    way = [(start + 1 + k) % len(contour) for k in range((end - start - 1) % len(contour))]
    distances = [abs(turn(a, b, contour[k])) / length for k in way]
    best = int(np.argmax(distances))
    return best, float(distances[best])

# %% name="distance to start" origin="new" sentence="Measure the distance to the line, not to the corner." must_say=["line"] kind="value"
def deepest_point(contour, start, end):
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = float(np.linalg.norm(contour[position] - contour[start]))
        if distance > depth:
            best, depth = position, distance
        position = (position + 1) % len(contour)
    return best, depth

# %% name="triangle" origin="new" sentence="There is no half: turn is the area of a parallelogram." must_say=["parallelogram|half"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = abs(turn(a, b, contour[position])) / 2 / length
        if distance > depth:
            best, depth = position, float(distance)
        position = (position + 1) % len(contour)
    return best, depth

# %% name="squared length" origin="new" sentence="The length is the square root of the sum of squares." must_say=["root"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = abs(turn(a, b, contour[position])) / length
        if distance > depth:
            best, depth = position, float(distance)
        position = (position + 1) % len(contour)
    return best, depth

# %% name="the point" origin="new" sentence="Return the position of the point, not the point." must_say=["position"] kind="type"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = a, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = abs(turn(a, b, contour[position])) / length
        if distance > depth:
            best, depth = contour[position], float(distance)
        position = (position + 1) % len(contour)
    return best, depth

# %% name="depth first" origin="new" sentence="The position comes first, then the depth." must_say=["position|exchanged"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = abs(turn(a, b, contour[position])) / length
        if distance > depth:
            best, depth = position, float(distance)
        position = (position + 1) % len(contour)
    return depth, best

# %% name="return in the loop" origin="new" sentence="Return after the loop." must_say=["loop|first point"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = abs(turn(a, b, contour[position])) / length
        if distance > depth:
            best, depth = position, float(distance)
        position = (position + 1) % len(contour)
        return best, depth

# %% name="range, from position 0" origin="walk" sentence="If start is larger than end, range is empty: count with % len(contour)." must_say=["% len|first one|empty"] kind="value"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, best_depth = 0, -1
    for i in range(start + 1, end):
        d = abs(turn(a, b, contour[i])) / length
        if d > best_depth:
            best, best_depth = i, d
    return best, best_depth

# %% name="start + 1 not wrapped" origin="walk" sentence="If start is the last position, start + 1 is too large: % len(contour)." must_say=["% len"] kind="error"
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

# %% name="beginning of the contour first" origin="walk" sentence="Of equal points the first on the way from start counts." must_say=["first"] kind="value"
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

# %% name="vertical distance" origin="walk" sentence="Measure the distance at a right angle to the line." must_say=["right angle|straight up"] kind="value"
def deepest_point(contour, start, end):
    best, best_depth = None, -1
    position = (start + 1) % len(contour)
    while position != end:
        d = abs(contour[position][1] - contour[start][1])
        if d > best_depth:
            best, best_depth = position, float(d)
        position = (position + 1) % len(contour)
    return best, best_depth
