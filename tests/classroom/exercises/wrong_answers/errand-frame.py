# %% name="tuples subtracted" sentence="Tuples cannot be subtracted: take their numbers one by one." must_say=["one by one"] kind="error"
def map_to_odom(place, counted):
    return place - counted

# %% name="two numbers" sentence="The yaw is missing in the result." must_say=["yaw"] kind="shape"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1]
