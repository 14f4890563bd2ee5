# %% name="abs" sentence="A negative free way is no way: return 0.0." must_say=["negative|0\\.0"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + 2 * deceleration * abs(free)))

# %% name="None" sentence="Return 0.0, a number, if nothing is free." must_say=["0\\.0"] kind="type"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return None
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + 2 * deceleration * free))
