# %% name="the formula alone" sentence="The limit and the question for free <= 0 are missing." must_say=["free <= 0", "limit"] kind="error"
def safe_speed(free, reaction, deceleration, limit):
    h = deceleration * reaction
    q = 2 * deceleration * free
    return -h + math.sqrt(h**2 + q)

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

# %% name="stop or go" sentence="Between 0 and limit there is the speed that just fits." must_say=["between|just"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if reaction * limit + limit**2 / (2 * deceleration) <= free:
        return limit
    return 0.0

# %% name="the distance" sentence="This is the stopping distance; the speed is asked." must_say=["speed"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    return min(limit, reaction * free + free**2 / (2 * deceleration))
