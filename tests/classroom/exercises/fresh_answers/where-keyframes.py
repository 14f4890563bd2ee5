# %% name="key in the wrong place" origin="fresh" sentence="Set the last keyframe only when a keyframe was found." must_say=["last keyframe"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    key = places[0]
    for k in range(1, len(places)):
        turned = abs(math.remainder(places[k][2] - key[2], 2 * math.pi))
        if math.dist(places[k][:2], key[:2]) >= distance or turned >= angle:
            numbers.append(k)
        key = places[k]
    return numbers

# %% name="remainder by pi" origin="fresh" sentence="A full turn is 2 pi: math.remainder(..., 2 * math.pi)." must_say=["2 \\* math\\.pi|2π|full turn"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = abs(math.remainder(a[2] - b[2], math.pi))
        if math.dist(a[:2], b[:2]) >= distance or turned >= angle:
            numbers.append(k)
    return numbers

# %% name="path length" origin="fresh" sentence="The straight distance counts, not the length of the way." must_say=["distance|last keyframe|math.dist"] kind="value"
def keyframes(places, distance, angle):
    numbers, way = [0], 0.0
    for k in range(1, len(places)):
        way += abs(places[k][0] - places[k - 1][0]) + abs(places[k][1] - places[k - 1][1])
        turned = abs(math.remainder(places[k][2] - places[numbers[-1]][2], 2 * math.pi))
        if way >= distance or turned >= angle:
            numbers.append(k)
            way = 0.0
    return numbers

# %% name="below" origin="fresh" sentence="A frame that is far enough is a keyframe: >=, not <." must_say=[">=|at least|far enough"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if math.dist(a[:2], b[:2]) < distance or turned < angle:
            numbers.append(k)
    return numbers

# %% name="no return" origin="fresh" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if math.dist(a[:2], b[:2]) >= distance or turned >= angle:
            numbers.append(k)
# %% name="frame before" origin="fresh" sentence="You compare with the frame before, not with the last keyframe." must_say=["last keyframe|frame before"] kind="value"
def keyframes(places, distance, angle):
    result = [0]
    for i in range(1, len(places)):
        x, y, yaw = places[i]
        old_x, old_y, old_yaw = places[i - 1]
        way = math.hypot(x - old_x, y - old_y)
        turned = abs(math.remainder(yaw - old_yaw, 2 * math.pi))
        if way >= distance or turned >= angle:
            result.append(i)
    return result
# %% name="> for >=" origin="fresh" sentence="At least means >=, not >." must_say=[">=|at least|exactly|equal"] kind="value"
def keyframes(places, distance, angle):
    result = [0]
    for i in range(1, len(places)):
        x, y, yaw = places[i]
        old_x, old_y, old_yaw = places[result[-1]]
        way = math.hypot(x - old_x, y - old_y)
        turned = abs(math.remainder(yaw - old_yaw, 2 * math.pi))
        if way > distance or turned > angle:
            result.append(i)
    return result
# %% name="angle forgotten" origin="fresh" sentence="A frame is also a keyframe if the yaw differs enough: the angle is not used." must_say=["angle|yaw|turn"] kind="value"
def keyframes(places, distance, angle):
    result = [0]
    last = places[0]
    for i in range(len(places)):
        place = places[i]
        if math.hypot(place[0] - last[0], place[1] - last[1]) >= distance:
            result.append(i)
            last = place
    return result
# %% name="yaw not wrapped" origin="fresh" sentence="3.1 and -3.1 are almost the same direction: the difference of the yaws must be wrapped." must_say=["remainder|wrap|same direction|π"] kind="value"
def keyframes(places, distance, angle):
    result = [0]
    last = places[0]
    for i in range(1, len(places)):
        place = places[i]
        way = math.hypot(place[0] - last[0], place[1] - last[1])
        turned = abs(place[2] - last[2])
        if way >= distance or turned >= angle:
            result.append(i)
            last = place
    return result
# %% name="and for or" origin="fresh" sentence="One of the two is enough: or, not and." must_say=["\\bor\\b|one of|either|enough"] kind="value"
def keyframes(places, distance, angle):
    result = [0]
    last = places[0]
    for i in range(1, len(places)):
        place = places[i]
        way = math.hypot(place[0] - last[0], place[1] - last[1])
        turned = abs(math.remainder(place[2] - last[2], 2 * math.pi))
        if way >= distance and turned >= angle:
            result.append(i)
            last = place
    return result
# %% name="no abs of the turn" origin="fresh" sentence="A turn to the right gives a negative difference: take abs." must_say=["abs|negative|right|sign|both"] kind="value"
def keyframes(places, distance, angle):
    result = [0]
    last = places[0]
    for i in range(1, len(places)):
        place = places[i]
        way = math.hypot(place[0] - last[0], place[1] - last[1])
        turned = math.remainder(place[2] - last[2], 2 * math.pi)
        if way >= distance or turned >= angle:
            result.append(i)
            last = place
    return result
# %% name="frame 0 missing" origin="fresh" sentence="Frame 0 is the first keyframe and is missing in the list." must_say=["0|first"] kind="value"
def keyframes(places, distance, angle):
    result = []
    last = places[0]
    for i in range(1, len(places)):
        place = places[i]
        way = math.hypot(place[0] - last[0], place[1] - last[1])
        turned = abs(math.remainder(place[2] - last[2], 2 * math.pi))
        if way >= distance or turned >= angle:
            result.append(i)
            last = place
    return result
# %% name="places, not numbers" origin="fresh" sentence="The list should hold the numbers of the frames, not their places." must_say=["number|index|position|tuple"] kind="type"
def keyframes(places, distance, angle):
    result = [places[0]]
    for place in places[1:]:
        last = result[-1]
        way = math.hypot(place[0] - last[0], place[1] - last[1])
        turned = abs(math.remainder(place[2] - last[2], 2 * math.pi))
        if way >= distance or turned >= angle:
            result.append(place)
    return result
# %% name="return in the loop" origin="fresh" sentence="The return is inside the loop, so only one frame is looked at." must_say=["return", "loop"] kind="value"
def keyframes(places, distance, angle):
    result = [0]
    last = places[0]
    for i in range(1, len(places)):
        place = places[i]
        way = math.hypot(place[0] - last[0], place[1] - last[1])
        turned = abs(math.remainder(place[2] - last[2], 2 * math.pi))
        if way >= distance or turned >= angle:
            result.append(i)
            last = place
        return result
# %% name="last never changes" origin="fresh" sentence="After a new keyframe the last one must be set to it; you always compare with frame 0." must_say=["last|frame 0|first frame"] kind="value"
def keyframes(places, distance, angle):
    result = [0]
    last = places[0]
    for i in range(1, len(places)):
        place = places[i]
        way = math.hypot(place[0] - last[0], place[1] - last[1])
        turned = abs(math.remainder(place[2] - last[2], 2 * math.pi))
        if way >= distance or turned >= angle:
            result.append(i)
    return result
