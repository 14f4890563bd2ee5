# %% name="None" sentence="Return math.inf, not None." must_say=["inf"] kind="type"
def time_to_collision(before, now, dt):
    if now > before:
        return dt * before / (now - before)

# %% name="exact text" sentence="now is not defined as time_now: use the names of the arguments." must_say=["name|defin|argument"] kind="error"
def time_to_collision(before, now, dt):
    if time_now <= before:
        return math.inf
    return dt * before / (time_now - before)

# %% name="rounded" sentence="Return the exact number: leave round out." must_say=["round|exact"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return round(dt * before / (now - before), 1)

# %% name="printed" sentence="You print the time and return nothing: write return." must_say=["return"] kind="no-return"
def time_to_collision(before, now, dt):
    if now <= before:
        print(math.inf)
    else:
        print(dt * before / (now - before))
