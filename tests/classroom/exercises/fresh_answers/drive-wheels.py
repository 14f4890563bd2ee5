# %% name="radius from the circle" origin="fresh" sentence="You compute the radius of the circle, and multiply it by the turn only for the right wheel: the left wheel has the radius minus half the distance." must_say=["left|half|distance"] kind="value"
def wheel_speeds(linear, angular, distance):
    radius = linear / angular
    left = angular * radius
    right = angular * (radius + distance / 2)
    return left, right

# %% name="minus twice" origin="fresh" sentence="Both wheels are slower: the right wheel gains speed in a turn to the left, so add for it." must_say=["right|add|plus|sign"] kind="value"
def wheel_speeds(linear, angular, distance):
    turn = angular * distance / 2
    return linear - turn, linear - turn

# %% name="turn times linear" origin="fresh" sentence="You multiply linear and turn. The turn is added to the linear velocity." must_say=["add|plus|sum|subtract|linear"] kind="value"
def wheel_speeds(linear, angular, distance):
    turn = angular * distance / 2
    return linear * -turn, linear * turn

# %% name="a text" origin="fresh" sentence="You return a text; return the two numbers." must_say=["text|string|f-string", "number|two|2"] kind="type"
def wheel_speeds(linear, angular, distance):
    turn = angular * distance / 2
    return f"{linear - turn}, {linear + turn}"

# %% name="quarter" origin="fresh" sentence="You halve the distance twice: half of it is the way from the centre to a wheel." must_say=["half|2|distance"] kind="value"
def wheel_speeds(linear, angular, distance):
    half = distance / 2
    turn = angular * half / 2
    return linear - turn, linear + turn
