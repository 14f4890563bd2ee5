# %% name="frame before" origin="new" sentence="Compare with the last keyframe, not with the frame before." must_say=["last keyframe"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[k - 1]
        moved = math.dist(a[:2], b[:2])
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if moved >= distance or turned >= angle:
            numbers.append(k)
    return numbers

# %% name="frame 0" origin="new" sentence="Compare with the last keyframe, not with frame 0." must_say=["last keyframe"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[0]
        moved = math.dist(a[:2], b[:2])
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if moved >= distance or turned >= angle:
            numbers.append(k)
    return numbers

# %% name="and" origin="new" sentence="One of both is enough: use or." must_say=["\\bor\\b"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        moved = math.dist(a[:2], b[:2])
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if moved >= distance and turned >= angle:
            numbers.append(k)
    return numbers

# %% name="no remainder" origin="new" sentence="Use math.remainder: 3.1 and -3.1 are almost the same direction." must_say=["remainder"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        if math.dist(a[:2], b[:2]) >= distance or abs(a[2] - b[2]) >= angle:
            numbers.append(k)
    return numbers

# %% name="no abs" origin="new" sentence="A turn to the right is negative: use abs." must_say=["abs"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = math.remainder(a[2] - b[2], 2 * math.pi)
        if math.dist(a[:2], b[:2]) >= distance or turned >= angle:
            numbers.append(k)
    return numbers

# %% name=">" origin="new" sentence="At least means >=." must_say=["at least|>="] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if math.dist(a[:2], b[:2]) > distance or turned > angle:
            numbers.append(k)
    return numbers

# %% name="empty list" origin="new" sentence="Frame 0 is missing: it is the first keyframe." must_say=["frame 0|first keyframe"] kind="value"
def keyframes(places, distance, angle):
    numbers = []
    last = places[0]
    for k in range(1, len(places)):
        a = places[k]
        turned = abs(math.remainder(a[2] - last[2], 2 * math.pi))
        if math.dist(a[:2], last[:2]) >= distance or turned >= angle:
            numbers.append(k)
            last = a
    return numbers

# %% name="list of places" origin="new" sentence="Return the numbers of the frames, not their places." must_say=["number"] kind="value"
def keyframes(places, distance, angle):
    found = [places[0]]
    for a in places[1:]:
        b = found[-1]
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if math.dist(a[:2], b[:2]) >= distance or turned >= angle:
            found.append(a)
    return found

# %% name="count" origin="new" sentence="Return the list, not how many there are." must_say=["list"] kind="type"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if math.dist(a[:2], b[:2]) >= distance or turned >= angle:
            numbers.append(k)
    return len(numbers)

# %% name="distance only" origin="new" sentence="A turn also makes a keyframe." must_say=["turn|angle"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        if math.dist(places[k][:2], places[numbers[-1]][:2]) >= distance:
            numbers.append(k)
    return numbers

# %% name="yaw in dist" origin="new" sentence="The distance has x and y only: your math.dist also takes the yaw." must_say=["yaw|two numbers"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if math.dist(a, b) >= distance or turned >= angle:
            numbers.append(k)
    return numbers

# %% name="squared" origin="new" sentence="This is the squared distance: take the root." must_say=["squar|root"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        squared = (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if squared >= distance or turned >= angle:
            numbers.append(k)
    return numbers

# %% name="x only" origin="new" sentence="The distance has two parts, x and y." must_say=["x and y|math\\.dist"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if abs(a[0] - b[0]) >= distance or turned >= angle:
            numbers.append(k)
    return numbers

# %% name="modulo" origin="new" sentence="% gives 0 to 2 pi: use math.remainder." must_say=["remainder"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = (a[2] - b[2]) % (2 * math.pi)
        if math.dist(a[:2], b[:2]) >= distance or turned >= angle:
            numbers.append(k)
    return numbers

# %% name="key never set" origin="new" sentence="Your last keyframe never changes: set it anew at each keyframe." must_say=["last keyframe"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    key = places[0]
    for k, a in enumerate(places):
        turned = abs(math.remainder(a[2] - key[2], 2 * math.pi))
        if math.dist(a[:2], key[:2]) >= distance or turned >= angle:
            numbers.append(k)
    return numbers

# %% name="way added up" origin="new" sentence="The robot may come back: compare the place with that of the last keyframe." must_say=["add up|last keyframe"] kind="value"
def keyframes(places, distance, angle):
    numbers, way = [0], 0.0
    for k in range(1, len(places)):
        way += math.dist(places[k][:2], places[k - 1][:2])
        turn = abs(math.remainder(places[k][2] - places[numbers[-1]][2], 2 * math.pi))
        if way >= distance or turn >= angle:
            numbers.append(k)
            way = 0.0
    return numbers

# %% name="degrees compared with radians" origin="new" sentence="angle is in radians: leave math.degrees out." must_say=["degrees", "radians"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        x, y, yaw = places[k]
        key_x, key_y, key_yaw = places[numbers[-1]]
        moved = math.dist((x, y), (key_x, key_y))
        turned = abs(math.remainder(yaw - key_yaw, 2 * math.pi))
        if moved >= distance or math.degrees(turned) >= angle:
            numbers.append(k)
    return numbers

# %% name="begins empty at the origin" origin="new" sentence="Frame 0 is missing: begin with [0], and with the place of frame 0." must_say=["frame 0", "empty|missing", "\\[0\\]"] kind="value"
def keyframes(places, distance, angle):
    numbers = []
    last = (0, 0, 0)
    for k in range(len(places)):
        x, y, yaw = places[k]
        moved = math.hypot(x - last[0], y - last[1])
        turned = abs(math.remainder(yaw - last[2], 2 * math.pi))
        if moved >= distance or turned >= angle:
            numbers.append(k)
            last = places[k]
    return numbers

# %% name="the number by places.index" origin="new" sentence="A robot can come back to a place: take the number from the loop." must_say=["places.index|come back", "loop|number of the frame"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    last = places[0]
    for place in places:
        turned = abs(math.remainder(place[2] - last[2], 2 * math.pi))
        if math.dist(place[:2], last[:2]) >= distance or turned >= angle:
            numbers.append(places.index(place))
            last = place
    return numbers
