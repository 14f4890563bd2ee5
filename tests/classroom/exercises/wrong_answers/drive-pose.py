# %% name="direction at the beginning" origin="new" sentence="You drive in the old direction; use the direction in the middle of the step, yaw + angular * dt / 2." must_say=["middle|dt / 2|half"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    x = x + linear * dt * math.cos(yaw)
    y = y + linear * dt * math.sin(yaw)
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)
    return x, y, yaw

# %% name="turned first" origin="new" sentence="You change yaw before you use it, so the robot drives in the direction at the end of the step: use the middle." must_say=["end|before|middle"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)
    x = x + linear * dt * math.cos(yaw)
    y = y + linear * dt * math.sin(yaw)
    return x, y, yaw

# %% name="yaw not limited" origin="new" sentence="The new yaw must stay between -pi and pi: use math.remainder." must_say=["pi", "remainder|between|whole turn"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    return x + linear * dt * math.cos(middle), y + linear * dt * math.sin(middle), yaw + angular * dt

# %% name="yaw by %" origin="new" sentence="% gives 0 to 2 pi; the task asks for -pi to pi, which math.remainder gives." must_say=["pi", "remainder|0 to 2|%"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    new_yaw = (yaw + angular * dt) % (2 * math.pi)
    return x + linear * dt * math.cos(middle), y + linear * dt * math.sin(middle), new_yaw

# %% name="sine for x" origin="new" sentence="Sine and cosine are exchanged: the cosine belongs to x." must_say=["cos"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.sin(middle)
    y = y + linear * dt * math.cos(middle)
    return x, y, math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="dt forgotten" origin="new" sentence="The way is linear * dt: without dt the robot drives too far." must_say=["\\bdt\\b"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * math.cos(middle)
    y = y + linear * math.sin(middle)
    return x, y, math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="the old place lost" origin="new" sentence="You return only the way of this step: add it to x and y." must_say=["add|old x|x and y"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = linear * dt * math.cos(middle)
    y = linear * dt * math.sin(middle)
    return x, y, math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="half the turn in yaw" origin="new" sentence="The middle is only for the way: the new yaw makes the whole turn, yaw + angular * dt." must_say=["half|whole|middle", "angular \\* dt|turn"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    yaw = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(yaw)
    y = y + linear * dt * math.sin(yaw)
    return x, y, math.remainder(yaw, 2 * math.pi)

# %% name="yaw not changed" origin="new" sentence="The robot also turns: return yaw + angular * dt." must_say=["turn|angular"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    return x, y, yaw

# %% name="cos without math" origin="new" sentence="cos belongs to the library math: write math.cos." must_say=["math"] kind="error"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    return x + linear * dt * cos(middle), y + linear * dt * sin(middle), math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="only the place" origin="new" sentence="The task asks for three values, x, y and yaw: yaw is missing." must_say=["three|3|yaw"] kind="type"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    return x + linear * dt * math.cos(middle), y + linear * dt * math.sin(middle)

# %% name="no return" origin="new" sentence="Your function returns nothing: end with return x, y, yaw." must_say=["return"] kind="no-return"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="y minus" origin="new" sentence="The way along y has the wrong sign: in a map, y grows to the left, not downward as the rows do." must_say=["sign|\\by\\b|minus"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y - linear * dt * math.sin(middle)
    return x, y, math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="remainder of pi" origin="new" sentence="Directions repeat after 2 pi, not after pi." must_say=["2 \\* math\\.pi|2 pi|whole turn|half a turn"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    return x, y, math.remainder(yaw + angular * dt, math.pi)

# %% name="rounded as the print" origin="new" sentence="You rounded: only the print in the lesson rounds, return the exact numbers." must_say=["round"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)
    return round(x, 4), round(y, 4), round(yaw, 3)
