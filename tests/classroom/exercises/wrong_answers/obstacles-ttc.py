# %% name="None" sentence="Return math.inf, not None." must_say=["inf"] kind="type"
def time_to_collision(before, now, dt):
    if now > before:
        return dt * before / (now - before)

# %% name="rounded" sentence="Return the exact number: leave round out." must_say=["round|exact"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return round(dt * before / (now - before), 1)
