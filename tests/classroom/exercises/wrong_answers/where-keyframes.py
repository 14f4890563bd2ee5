# %% name="distance only" sentence="A turn also makes a keyframe." must_say=["turn|angle"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        if math.dist(places[k][:2], places[numbers[-1]][:2]) >= distance:
            numbers.append(k)
    return numbers

# %% name="no remainder" sentence="Use math.remainder: 3.1 and -3.1 are almost the same direction." must_say=["remainder"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        a, b = places[k], places[numbers[-1]]
        if math.dist(a[:2], b[:2]) >= distance or abs(a[2] - b[2]) >= angle:
            numbers.append(k)
    return numbers
