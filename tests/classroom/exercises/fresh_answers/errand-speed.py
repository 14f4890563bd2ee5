# %% name="without reaction" origin="fresh" sentence="The robot also drives on during the reaction: your speed is too high." must_say=["reaction"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    return min(limit, math.sqrt(2 * deceleration * free))

# %% name="free / reaction" origin="fresh" sentence="This is the speed without the way of braking." must_say=["brak"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    return min(limit, free / reaction)

# %% name="no limit" origin="fresh" sentence="The speed must not be higher than limit." must_say=["limit"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    a, b = 1 / (2 * deceleration), reaction
    return (-b + math.sqrt(b**2 + 4 * a * free)) / (2 * a)

# %% name="negative way" origin="fresh" sentence="If free is negative, the root does not exist: return 0.0." must_say=["negative|0\\.0"] kind="error"
def safe_speed(free, reaction, deceleration, limit):
    at = deceleration * reaction
    speed = -at + math.sqrt(at**2 + 2 * deceleration * free)
    return max(0.0, min(speed, limit))

# %% name="steps of a centimetre per second" origin="fresh" sentence="You try speeds in steps, so the result is rounded down. Solve the equation." must_say=["steps|exact|rounded|equation|solve"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    speed = 0.0
    while speed + 0.01 <= limit and reaction * (speed + 0.01) + (speed + 0.01) ** 2 / (2 * deceleration) <= free:
        speed += 0.01
    return speed
