# %% name="rate for 1 / rate" origin="new" sentence="The rate is frames per second, not a time: the wait is 1 / rate." must_say=["1 / |per second|time"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (rate + latency)
    braking = speed**2 / (2 * deceleration)
    return before + braking

# %% name="no braking" origin="new" sentence="The way of braking is missing: speed ** 2 / (2 * deceleration)." must_say=["brak"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    return speed / rate + speed * latency

# %% name="2 outside of the parentheses" origin="new" sentence="Put 2 * deceleration into parentheses: / 2 * deceleration multiplies by it." must_say=["parenthes|\\(2 \\*"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (1 / rate + latency)
    return before + speed * speed / 2 * deceleration

# %% name="speed not squared" origin="new" sentence="Square the speed in the way of braking." must_say=["squar|\\*\\* ?2"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (1 / rate + latency)
    return before + speed / (2 * deceleration)

# %% name="the 2 forgotten" origin="new" sentence="The way of braking is half of yours: divide by 2 * deceleration." must_say=["2"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (1 / rate + latency)
    return before + speed**2 / deceleration

# %% name="rounded" origin="new" sentence="Return the exact number: leave round out." must_say=["round"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (1 / rate + latency)
    braking = speed**2 / (2 * deceleration)
    return round(before + braking, 3)

# %% name="^ as a power" origin="new" sentence="In Python ^ is not a power: write speed ** 2." must_say=["\\*\\*|power|\\^"] kind="error"
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + speed ^ 2 / (2 * deceleration)

# %% name="the numbers of the lesson" origin="new" sentence="You typed 0.6, 10 and 0.06: use the arguments." must_say=["argument|input|typed|receives"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / 10 + 0.06) + speed**2 / (2 * 0.6)

# %% name="the example" origin="new" sentence="You typed the result of the example: compute it from the arguments." must_say=["every input|argument|fixed|comput"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    return 0.123

# %% name="a text with m" origin="new" sentence="Return the number alone, without the unit." must_say=["number|text|unit"] kind="type"
def stopping_distance(speed, deceleration, rate, latency):
    d = speed * (1 / rate + latency) + speed**2 / (2 * deceleration)
    return f"{d} m"

# %% name="calls the function of the lesson" origin="new" sentence="distance_of is another cell's function, and it takes only the speed: compute with the arguments." must_say=["distance_of|argument|cell|defin"] kind="other-cell"
def stopping_distance(speed, deceleration, rate, latency):
    return distance_of(speed)

# %% name="* 2 for ** 2" origin="new" sentence="* 2 doubles the speed; ** 2 squares it." must_say=["squar", "\\*\\* ?2"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (1 / rate + latency)
    braking = speed * 2 / (2 * deceleration)
    return before + braking

# %% name="the time of braking as a way" origin="new" sentence="speed / deceleration is the time of braking; the way is speed ** 2 / (2 * deceleration)." must_say=["time", "\\*\\* ?2"] kind="value"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (1 / rate + latency)
    return before + speed / deceleration
