# %% name="no braking" sentence="The way of braking is missing: speed ** 2 / (2 * deceleration)." must_say=["brak"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    return speed / rate + speed * latency

# %% name="^ as a power" sentence="In Python ^ is not a power: write speed ** 2." must_say=["\\*\\*|power|\\^"] kind="error"
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + speed ^ 2 / (2 * deceleration)

# %% name="calls the function of the lesson" sentence="distance_of is another cell's function, and it takes only the speed: compute with the arguments." must_say=["distance_of|argument|cell|defin"] kind="other-cell"
def stopping_distance(speed, deceleration, rate, latency):
    return distance_of(speed)

# %% name="a text with m" sentence="Return the number alone, without the unit." must_say=["number|text|unit"] kind="type"
def stopping_distance(speed, deceleration, rate, latency):
    d = speed * (1 / rate + latency) + speed**2 / (2 * deceleration)
    return f"{d} m"

# %% name="the numbers of the lesson" sentence="You typed 0.6, 10 and 0.06: use the arguments." must_say=["argument|input|typed|receives"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / 10 + 0.06) + speed**2 / (2 * 0.6)
