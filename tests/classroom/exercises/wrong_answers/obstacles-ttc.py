# %% name="now above" origin="new" sentence="The time from now has the width before above the line." must_say=["before"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return dt * now / (now - before)

# %% name="no dt" origin="new" sentence="Multiply by dt: otherwise the result is not in seconds." must_say=["\\bdt\\b"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return before / (now - before)

# %% name="divided by dt" origin="new" sentence="Multiply by dt instead of dividing." must_say=["multipl"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return before / (now - before) / dt

# %% name="upside down" origin="new" sentence="The fraction is upside down." must_say=["upside|large growth|before / "] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return dt * (now - before) / before

# %% name="no parentheses" origin="new" sentence="Put now - before into parentheses." must_say=["parenthes"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return dt * before / now - before

# %% name="negative" origin="new" sentence="If the object becomes smaller, return math.inf, not a negative time." must_say=["inf"] kind="value"
def time_to_collision(before, now, dt):
    if now == before:
        return math.inf
    return dt * before / (now - before)

# %% name="0 if it does not grow" origin="new" sentence="0 s means a collision now: return math.inf." must_say=["inf"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return 0
    return dt * before / (now - before)

# %% name="None" origin="new" sentence="Return math.inf, not None." must_say=["inf"] kind="type"
def time_to_collision(before, now, dt):
    if now > before:
        return dt * before / (now - before)

# %% name="a text" origin="new" sentence="Return the number math.inf, not a text." must_say=["inf|number"] kind="type"
def time_to_collision(before, now, dt):
    if now <= before:
        return "no collision"
    return dt * before / (now - before)

# %% name="whole numbers" origin="new" sentence="// drops the fraction: use /." must_say=["/|fraction|whole"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return dt * before // (now - before)

# %% name="before minus now" origin="new" sentence="The difference is the other way round: now - before." must_say=["now - before|sign|other way"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return dt * before / (before - now)

# %% name="printed" origin="new" sentence="You print the time and return nothing: write return." must_say=["return"] kind="no-return"
def time_to_collision(before, now, dt):
    if now <= before:
        print(math.inf)
    else:
        print(dt * before / (now - before))

# %% name="0.5" origin="new" sentence="Use the argument dt, not 0.5." must_say=["\\bdt\\b"] kind="value"
def time_to_collision(before, now, dt):
    if now <= before:
        return math.inf
    return 0.5 * before / (now - before)

# %% name="abs" origin="new" sentence="abs hides that the object moves away: return math.inf then." must_say=["inf|abs"] kind="value"
def time_to_collision(before, now, dt):
    if now == before:
        return math.inf
    return dt * before / abs(now - before)

# %% name="exact text" origin="new" sentence="now is not defined as time_now: use the names of the arguments." must_say=["name|defin|argument"] kind="error"
def time_to_collision(before, now, dt):
    if time_now <= before:
        return math.inf
    return dt * before / (time_now - before)
