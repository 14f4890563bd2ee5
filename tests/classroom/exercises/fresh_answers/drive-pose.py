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
# %% name="direction at the start" origin="fresh" sentence="The direction is that at the start of the step, not that in the middle." must_say=["middle"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    x = x + linear * dt * math.cos(yaw)
    y = y + linear * dt * math.sin(yaw)
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)
    return x, y, yaw
# %% name="remainder thrown away" origin="fresh" sentence="math.remainder returns a new number; the result is not kept, so yaw is not wrapped." must_say=["keep|kept|new (value|number)|yaw = "] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    yaw = yaw + angular * dt
    math.remainder(yaw, 2 * math.pi)
    return x, y, yaw
# %% name="whole turn for the middle" origin="fresh" sentence="The middle of the step is after half of the turn: divide angular * dt by 2." must_say=["middle|half"] must_not_say=["yaw was changed"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    return x, y, math.remainder(middle, 2 * math.pi)
# %% name="sin and cos exchanged" origin="fresh" sentence="x needs the cosine and y the sine." must_say=["cos|sin|x and y|exchang|swap"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.sin(middle)
    y = y + linear * dt * math.cos(middle)
    yaw = yaw + angular * dt
    return x, y, math.remainder(yaw, 2 * math.pi)
# %% name="remainder of pi" origin="fresh" sentence="A whole turn is 2 pi, not pi." must_say=["2 ?(\\*|·)? ?(math\\.)?(π|pi)|whole turn|half a turn"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    yaw = math.remainder(yaw + angular * dt, math.pi)
    return x, y, yaw
# %% name="from 0 to 2 pi" origin="fresh" sentence="% 2π gives angles from 0 to 2π, but the task wants −π to π." must_say=["[−-] ?(π|pi)|remainder"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    yaw = (yaw + angular * dt) % (2 * math.pi)
    return x, y, yaw
# %% name="cosine of degrees" origin="fresh" sentence="math.cos wants radians; yaw is in radians already, and you turn it to degrees." must_say=["radian|degrees"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = math.degrees(yaw + angular * dt / 2)
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)
    return x, y, yaw
# %% name="prints" origin="fresh" sentence="You print the three numbers; return them." must_say=["print", "return"] kind="type"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)
    print(x, y, yaw)
# %% name="old x and y forgotten" origin="fresh" sentence="The way of the step must be added to the old x and y." must_say=["add|old|start|given x|x and y"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    new_x = linear * dt * math.cos(middle)
    new_y = linear * dt * math.sin(middle)
    new_yaw = math.remainder(yaw + angular * dt, 2 * math.pi)
    return new_x, new_y, new_yaw
# %% name="dt of the lesson" origin="fresh" sentence="dt is set to 0.1 in the function, so the given dt is lost." must_say=["another value|overwrit|writes? over|does not use|is lost"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    dt = 0.1  # seconds
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)
    return x, y, yaw
