# %% name="yaw not limited" sentence="The new yaw must stay between -pi and pi: use math.remainder." must_say=["pi", "remainder|between|whole turn"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    return x + linear * dt * math.cos(middle), y + linear * dt * math.sin(middle), yaw + angular * dt

# %% name="cos without math" sentence="cos belongs to the library math: write math.cos." must_say=["math"] kind="error"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    return x + linear * dt * cos(middle), y + linear * dt * sin(middle), math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="only the place" sentence="The task asks for three values, x, y and yaw: yaw is missing." must_say=["three|3|yaw"] kind="type"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    return x + linear * dt * math.cos(middle), y + linear * dt * math.sin(middle)

# %% name="no return" sentence="Your function returns nothing: end with return x, y, yaw." must_say=["return"] kind="no-return"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)

# %% name="direction at the start" sentence="The direction is that at the start of the step, not that in the middle." must_say=["middle"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    x = x + linear * dt * math.cos(yaw)
    y = y + linear * dt * math.sin(yaw)
    yaw = math.remainder(yaw + angular * dt, 2 * math.pi)
    return x, y, yaw
