# %% name="distance only" sentence="A turn also makes a keyframe." must_say=["turn|angle"] kind="value"
def keyframes(places, distance, angle):
    numbers = [0]
    for k in range(1, len(places)):
        if math.dist(places[k][:2], places[numbers[-1]][:2]) >= distance:
            numbers.append(k)
    return numbers
