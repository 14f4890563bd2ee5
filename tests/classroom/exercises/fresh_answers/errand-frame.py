# %% name="only moved" origin="fresh" sentence="The frame is also turned: turn counted into the map, before you subtract it." must_say=["turn"] kind="value"
def map_to_odom(place, counted):
    x, y, yaw = place
    u, v, turned = counted
    return x - u, y - v, math.remainder(yaw - turned, 2 * math.pi)

# %% name="counted turned by the yaw of the place" origin="fresh" sentence="You turn by the yaw of the place; turn by the difference of both yaws." must_say=["difference|yaw"] kind="value"
def map_to_odom(place, counted):
    yaw = place[2] - counted[2]
    c, s = math.cos(place[2]), math.sin(place[2])
    x = place[0] - c * counted[0] + s * counted[1]
    y = place[1] - s * counted[0] - c * counted[1]
    return x, y, math.remainder(yaw, 2 * math.pi)

# %% name="a sum of the yaws" origin="fresh" sentence="The yaw is the difference: that of the place, less the counted one." must_say=["difference|less|minus|subtract|-"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] + counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    x = place[0] - c * counted[0] + s * counted[1]
    y = place[1] - s * counted[0] - c * counted[1]
    return x, y, yaw

# %% name="composed instead" origin="fresh" sentence="You compose place and counted. The result is the frame, from which counted leads to place: turn counted, and subtract it." must_say=["subtract|less|minus|difference"] kind="value"
def map_to_odom(place, counted):
    x, y, yaw = place
    u, v, turned = counted
    c, s = math.cos(yaw), math.sin(yaw)
    return x + c * u - s * v, y + s * u + c * v, math.remainder(yaw + turned, 2 * math.pi)

# %% name="atan2 of the difference" origin="fresh" sentence="The yaw of the frame is the difference of both yaws, not the direction from one place to the other." must_say=["yaw"] kind="value"
def map_to_odom(place, counted):
    yaw = math.atan2(place[1] - counted[1], place[0] - counted[0])
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw
