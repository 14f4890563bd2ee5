# %% name="yaw not limited" sentence="The new yaw must stay between -pi and pi: use math.remainder." must_say=["pi", "remainder|between|whole turn"] kind="value"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    return x + linear * dt * math.cos(middle), y + linear * dt * math.sin(middle), yaw + angular * dt
