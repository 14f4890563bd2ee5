# %% name="tuples subtracted" sentence="Tuples cannot be subtracted: take their numbers one by one." must_say=["one by one"] kind="error"
def map_to_odom(place, counted):
    return place - counted

# %% name="wrapped by hand, only from below" sentence="The angle can also be larger than π: wrap it on that side, too." must_say=["larger than π"] must_not_say=["not wrapped"] kind="value"
def map_to_odom(place, counted):
    yaw = place[2] - counted[2]
    while yaw < -math.pi:
        yaw += 2 * math.pi
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw

# %% name="two numbers" sentence="The yaw is missing in the result." must_say=["yaw"] kind="shape"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1]

# %% name="no return" sentence="The function returns nothing: return x, y and yaw." must_say=["return"] kind="no-return"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    x = place[0] - c * counted[0] + s * counted[1]
    y = place[1] - s * counted[0] - c * counted[1]

# %% name="wrapped by hand, only from above" sentence="The angle can also be smaller than -π: wrap it on that side, too." must_say=["smaller than -π"] must_not_say=["not wrapped"] kind="value"
def map_to_odom(place, counted):
    yaw = place[2] - counted[2]
    if yaw > math.pi:
        yaw -= 2 * math.pi
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw
