# %% name="two frames" origin="fresh" sentence="You count two frames; one is enough." must_say=["one|1 / rate|frame"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (2 / rate + latency)
    return before + speed**2 / (2 * deceleration)

# %% name="braking subtracted" origin="fresh" sentence="Add the way of braking; do not subtract it." must_say=["add|plus|sum|subtract|sign"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (1 / rate + latency)
    return before - speed**2 / (2 * deceleration)

# %% name="both in a tuple" origin="fresh" sentence="Return the sum of both ways, one number." must_say=["sum|one number|alone|add"] kind="type"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (1 / rate + latency)
    braking = speed**2 / (2 * deceleration)
    return before, braking

# %% name="deceleration times time" origin="fresh" sentence="You brake for the latency only: the robot brakes until it stands still, speed ** 2 / (2 * deceleration)." must_say=["brak|speed"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    wait = 1 / rate + latency
    return speed * wait + deceleration * wait**2 / 2

# %% name="whole speed while braking" origin="fresh" sentence="While it brakes, the mean speed is half: the braking time is speed / deceleration, multiplied by speed / 2." must_say=["half|2"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    time = speed / deceleration
    return speed * (1 / rate + latency + time)
