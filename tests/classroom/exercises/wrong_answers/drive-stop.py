# %% name="a text with m" sentence="Return the number alone, without the unit." must_say=["number|text|unit"] kind="type"
def stopping_distance(speed, deceleration, rate, latency):
    d = speed * (1 / rate + latency) + speed**2 / (2 * deceleration)
    return f"{d} m"
