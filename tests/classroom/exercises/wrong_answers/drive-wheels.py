# %% name="plus for the left wheel" origin="new" sentence="You add for the left wheel and subtract for the right one: with a positive angular velocity the robot turns to the left, and its right wheel is the faster one." must_say=["left|right", "exchang|swap|faster|subtract"] kind="value"
def wheel_speeds(linear, angular, distance):
    left = linear + angular * distance / 2
    right = linear - angular * distance / 2
    return left, right

# %% name="the whole distance" origin="new" sentence="A wheel is only half the distance away from the centre: use distance / 2." must_say=["half|/ ?2"] kind="value"
def wheel_speeds(linear, angular, distance):
    return linear - angular * distance, linear + angular * distance

# %% name="parentheses around everything" origin="new" sentence="Your parentheses halve the linear velocity too; only angular * distance is divided by 2." must_say=["parenthes|halve|linear", "2"] kind="value"
def wheel_speeds(linear, angular, distance):
    left = (linear - angular * distance) / 2
    right = (linear + angular * distance) / 2
    return left, right

# %% name="angular added directly" origin="new" sentence="You add rad/s to m/s: multiply the angular velocity by half the distance first." must_say=["rad|multipl", "distance"] kind="value"
def wheel_speeds(linear, angular, distance):
    left = linear - angular
    right = linear + angular
    return left, right

# %% name="the example robot" origin="new" sentence="You typed 0.1, which is right for the robot of the lesson only: use distance / 2." must_say=["distance", "argument|0\\.1|typed|other robots"] kind="value"
def wheel_speeds(linear, angular, distance):
    half = 0.1
    return linear - angular * half, linear + angular * half

# %% name="the turn only" origin="new" sentence="Your robot turns on the spot, because the linear velocity is missing." must_say=["linear|on the spot"] kind="value"
def wheel_speeds(linear, angular, distance):
    turn = angular * distance / 2
    return -turn, turn

# %% name="absolute values" origin="new" sentence="A wheel that turns backward has a negative speed: leave abs out." must_say=["negative|abs"] kind="value"
def wheel_speeds(linear, angular, distance):
    turn = angular * distance / 2
    return abs(linear - turn), abs(linear + turn)

# %% name="a dictionary" origin="new" sentence="The task asks for two numbers, and you return a dict." must_say=["dict", "two|number|values|tuple"] kind="type"
def wheel_speeds(linear, angular, distance):
    turn = angular * distance / 2
    return {"left": linear - turn, "right": linear + turn}

# %% name="printed" origin="new" sentence="You print the speeds and return nothing: write return." must_say=["return"] kind="no-return"
def wheel_speeds(linear, angular, distance):
    turn = angular * distance / 2
    print(linear - turn, linear + turn)

# %% name="only one number" origin="new" sentence="You return one number, and the task asks for two." must_say=["two|2 values|both"] kind="type"
def wheel_speeds(linear, angular, distance):
    return linear + angular * distance / 2

# %% name="names of the lesson" origin="new" sentence="The names v and w are not known in the function: its arguments are linear and angular." must_say=["linear|angular|argument|name|\\bv\\b"] kind="other-cell"
def wheel_speeds(linear, angular, distance):
    half = distance / 2
    return v - w * half, v + w * half

# %% name="degrees" origin="new" sentence="angular is in radians already: leave math.degrees out." must_say=["radian|degrees"] kind="value"
def wheel_speeds(linear, angular, distance):
    turn = math.degrees(angular) * distance / 2
    return linear - turn, linear + turn

# %% name="rounded as the print" origin="new" sentence="You rounded: only the print in the lesson rounds, return the exact numbers." must_say=["round"] kind="value"
def wheel_speeds(linear, angular, distance):
    half = distance / 2
    left = linear - angular * half
    right = linear + angular * half
    return round(left, 2), round(right, 2)

# %% name="half of the cell above" origin="new" sentence="half is the value of an earlier cell: use the argument distance." must_say=["half", "argument"] kind="value"
def wheel_speeds(linear, angular, distance):
    left = linear - angular * half
    right = linear + angular * half
    return left, right

# %% name="the turn times the linear velocity" origin="new" sentence="The turn does not depend on the linear velocity: angular * distance / 2." must_say=["linear velocity", "turn"] kind="value"
def wheel_speeds(linear, angular, distance):
    half = distance / 2
    left = linear - linear * angular * half
    right = linear + linear * angular * half
    return left, right
