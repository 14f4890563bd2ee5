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
