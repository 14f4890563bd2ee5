# %% name="turn without dt" origin="fresh" sentence="The turn in a step is angular * dt: in your middle and in your yaw dt is missing." must_say=["\\bdt\\b"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    return x, y, math.remainder(yaw + angular, 2 * math.pi)

# %% name="way in degrees" origin="fresh" sentence="math.cos takes radians, and yaw is in radians: leave math.degrees out." must_say=["radian|degrees"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = math.degrees(yaw + angular * dt / 2)
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    return x, y, math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="tangent" origin="fresh" sentence="y takes the sine of the direction, not the tangent." must_say=["sin|\\by\\b"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.tan(middle)
    return x, y, math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="fmod" origin="fresh" sentence="math.fmod keeps the sign of the number and does not give -pi to pi: use math.remainder." must_say=["pi", "remainder|between"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    return x, y, math.fmod(yaw + angular * dt, 2 * math.pi)

# %% name="yaw first" origin="fresh" sentence="The order is wrong: return x, y and then yaw." must_say=["order|x, y"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    return math.remainder(yaw + angular * dt, 2 * math.pi), x, y
