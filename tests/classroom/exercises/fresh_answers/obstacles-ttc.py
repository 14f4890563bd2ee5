# %% name="growth only" origin="fresh" sentence="You divide dt by the growth: multiply by the width before." must_say=["before|width"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return dt / (now - before)

# %% name="minus dt" origin="fresh" sentence="The formula counts from now already: do not subtract dt." must_say=["subtract|dt|now"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return dt * before / (now - before) - dt

# %% name="ratio minus 1 above" origin="fresh" sentence="dt is divided by the ratio minus 1, not multiplied." must_say=["divid|upside|growth"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return dt * (now / before - 1)

# %% name="the other case" origin="fresh" sentence="Your condition is the wrong way: infinity if the object does not grow." must_say=["inf|grow"] kind="value"
def time_to_collision(before, now, dt):
    if now >= before:
        return math.inf
    return dt * before / (now - before)

# %% name="rounded" origin="fresh" sentence="Return the exact number: leave round out." must_say=["round|exact"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return round(dt * before / (now - before), 1)
