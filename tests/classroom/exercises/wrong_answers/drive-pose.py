# %% name="yaw not limited" sentence="The new yaw must stay between -pi and pi: use math.remainder." must_say=["pi", "remainder|between|whole turn"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    return x + linear * dt * math.cos(middle), y + linear * dt * math.sin(middle), yaw + angular * dt

# %% name="cos without math" sentence="cos belongs to the library math: write math.cos." must_say=["math"] kind="error"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    return x + linear * dt * cos(middle), y + linear * dt * sin(middle), math.remainder(yaw + angular * dt, 2 * math.pi)
