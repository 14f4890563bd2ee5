# %% name="a list of differences" origin="new" sentence="Turn the counted way before you subtract it." must_say=["turn"] kind="value"
def map_to_odom(place, counted):
    return [p - q for p, q in zip(place, counted)]

# %% name="arrays subtracted" origin="new" sentence="Turn the counted way before you subtract it." must_say=["turn"] kind="value"
def map_to_odom(place, counted):
    return np.array(place) - np.array(counted)

# %% name="the yaw of the place in c and s" origin="new" sentence="Turn by the yaw of the frame, which is the difference of both yaws." must_say=["difference"] kind="value"
def map_to_odom(place, counted):
    x, y, yaw = place
    u, v, turned = counted
    c, s = math.cos(yaw), math.sin(yaw)
    return x - c * u + s * v, y - s * u - c * v, math.remainder(yaw - turned, 2 * math.pi)

# %% name="the counted yaw in c and s" origin="new" sentence="Turn by the yaw of the frame, which is the difference of both yaws." must_say=["difference"] kind="value"
def map_to_odom(place, counted):
    x, y, yaw = place
    u, v, turned = counted
    c, s = math.cos(turned), math.sin(turned)
    return x - c * u + s * v, y - s * u - c * v, math.remainder(yaw - turned, 2 * math.pi)

# %% name="no remainder" origin="new" sentence="Wrap the yaw between -π and π." must_say=["wrap"] kind="value"
def map_to_odom(place, counted):
    yaw = place[2] - counted[2]
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw

# %% name="modulo" origin="new" sentence="% gives 0 to 2π; use math.remainder." must_say=["remainder"] kind="value"
def map_to_odom(place, counted):
    yaw = (place[2] - counted[2]) % (2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw

# %% name="remainder by pi" origin="new" sentence="A whole turn is 2π, not π." must_say=["2 \\* math\\.pi|2π"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw

# %% name="math.fmod" origin="new" sentence="fmod keeps the sign, but not the range: use math.remainder." must_say=["remainder"] kind="value"
def map_to_odom(place, counted):
    yaw = math.fmod(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw

# %% name="compose of both" origin="new" sentence="compose(frame, counted) must be the place; you compose the place itself." must_say=["frame"] kind="value"
def map_to_odom(place, counted):
    return compose(place, counted)

# %% name="compose, exchanged" origin="new" sentence="compose(frame, counted) must be the place; you compose the counted pose." must_say=["compose"] kind="value"
def map_to_odom(place, counted):
    return compose(counted, place)

# %% name="compose with negative numbers" origin="new" sentence="The inverse of a pose is not its negative: its way must be turned, too." must_say=["turn"] kind="value"
def map_to_odom(place, counted):
    return compose(place, (-counted[0], -counted[1], -counted[2]))

# %% name="counted yaw minus the other" origin="new" sentence="The sign of the yaw is wrong: the place's yaw less the counted one." must_say=["sign|place\\[2\\] - counted\\[2\\]"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(counted[2] - place[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw

# %% name="plus the way" origin="new" sentence="Subtract the turned way; you add it." must_say=["subtract"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] + c * counted[0] - s * counted[1], place[1] + s * counted[0] + c * counted[1], yaw

# %% name="inverse rotation" origin="new" sentence="A sign of s is wrong: you turn to the wrong side." must_say=["wrong side|sign"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - (c * counted[0] + s * counted[1]), place[1] - (c * counted[1] - s * counted[0]), yaw

# %% name="a bracket forgotten" origin="new" sentence="Parentheses are missing around what you subtract." must_say=["parenthes"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] - s * counted[1], place[1] - s * counted[0] + c * counted[1], yaw

# %% name="a bracket forgotten in x" origin="new" sentence="Parentheses are missing around what you subtract from x." must_say=["parenthes|minus|c \\* u - s \\* v"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    x = place[0] - c * counted[0] - s * counted[1]
    y = place[1] - (s * counted[0] + c * counted[1])
    return x, y, yaw

# %% name="the difference of the places turned" origin="new" sentence="Turn only the counted way; the place is in the map already." must_say=["counted way"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    dx, dy = place[0] - counted[0], place[1] - counted[1]
    return c * dx - s * dy, s * dx + c * dy, yaw

# %% name="the relative pose" origin="new" sentence="This is the place as seen from the counted pose; they are in two frames." must_say=["relative|seen from"] kind="value"
def map_to_odom(place, counted):
    c, s = math.cos(counted[2]), math.sin(counted[2])
    dx, dy = place[0] - counted[0], place[1] - counted[1]
    return c * dx + s * dy, c * dy - s * dx, math.remainder(place[2] - counted[2], 2 * math.pi)

# %% name="map in odom" origin="new" sentence="This is the inverse: where the map stands in odom." must_say=["inverse"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(counted[2] - place[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return counted[0] - c * place[0] + s * place[1], counted[1] - s * place[0] - c * place[1], yaw

# %% name="yaw in degrees" origin="new" sentence="Return radians." must_say=["radian"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], math.degrees(yaw)

# %% name="wrapped by 180" origin="new" sentence="The yaw is in radians: wrap it by 2π, not by 360." must_say=["2 \\* math\\.pi|radian"] kind="value"
def map_to_odom(place, counted):
    yaw = place[2] - counted[2]
    if yaw > 180:
        yaw -= 360
    if yaw < -180:
        yaw += 360
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw

# %% name="sin for cos" origin="new" sentence="Sine and cosine are exchanged." must_say=["exchanged|cosine"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    s, c = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw

# %% name="two numbers" origin="new" sentence="The yaw is missing in the result." must_say=["yaw"] kind="shape"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1]

# %% name="the place again" origin="new" sentence="This is where the robot is, not where its frame stands." must_say=["frame"] kind="value"
def map_to_odom(place, counted):
    return place

# %% name="u overwritten" origin="new" sentence="x is overwritten before y is computed from it." must_say=["overwrit"] kind="value"
def map_to_odom(place, counted):
    x, y, turned = counted
    yaw = math.remainder(place[2] - turned, 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    x = c * x - s * y
    y = s * x + c * y
    return place[0] - x, place[1] - y, yaw

# %% name="no return" origin="new" sentence="The function returns nothing: return x, y and yaw." must_say=["return"] kind="no-return"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    x = place[0] - c * counted[0] + s * counted[1]
    y = place[1] - s * counted[0] - c * counted[1]

# %% name="three decimals" origin="new" sentence="Do not round." must_say=["round"] kind="value"
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], 2 * math.pi)
    c, s = math.cos(yaw), math.sin(yaw)
    x = place[0] - c * counted[0] + s * counted[1]
    y = place[1] - s * counted[0] - c * counted[1]
    return round(x, 3), round(y, 3), round(yaw, 3)

# %% name="tuples subtracted" origin="walk" sentence="Tuples cannot be subtracted: take their numbers one by one." must_say=["one by one"] kind="error"
def map_to_odom(place, counted):
    return place - counted

# %% name="wrapped by hand, only from above" origin="walk" sentence="The angle can also be smaller than -π: wrap it on that side, too." must_say=["smaller than -π"] must_not_say=["not wrapped"] kind="value"
def map_to_odom(place, counted):
    yaw = place[2] - counted[2]
    if yaw > math.pi:
        yaw -= 2 * math.pi
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw

# %% name="wrapped by hand, only from below" origin="walk" sentence="The angle can also be larger than π: wrap it on that side, too." must_say=["larger than π"] must_not_say=["not wrapped"] kind="value"
def map_to_odom(place, counted):
    yaw = place[2] - counted[2]
    while yaw < -math.pi:
        yaw += 2 * math.pi
    c, s = math.cos(yaw), math.sin(yaw)
    return place[0] - c * counted[0] + s * counted[1], place[1] - s * counted[0] - c * counted[1], yaw
