# %% name="distance only" sentence="A turn also makes a keyframe." must_say=["turn|angle"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        if math.dist(places[k][:2], places[numbers[-1]][:2]) >= distance:
            numbers.append(k)
    return numbers

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if math.dist(a[:2], b[:2]) >= distance or turned >= angle:
            numbers.append(k)

# %% name="count" sentence="Return the list, not how many there are." must_say=["list"] kind="type"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = abs(math.remainder(a[2] - b[2], 2 * math.pi))
        if math.dist(a[:2], b[:2]) >= distance or turned >= angle:
            numbers.append(k)
    return len(numbers)

# %% name="no remainder" sentence="Use math.remainder: 3.1 and -3.1 are almost the same direction." must_say=["remainder"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        if math.dist(a[:2], b[:2]) >= distance or abs(a[2] - b[2]) >= angle:
            numbers.append(k)
    return numbers

# %% name="no abs" sentence="A turn to the right is negative: use abs." must_say=["abs"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        turned = math.remainder(a[2] - b[2], 2 * math.pi)
        if math.dist(a[:2], b[:2]) >= distance or turned >= angle:
            numbers.append(k)
    return numbers
