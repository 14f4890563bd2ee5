# %% name="the whole distance" sentence="A wheel is only half the distance away from the centre: use distance / 2." must_say=["half|/ ?2"] kind="value"
def wheel_speeds(linear, angular, distance):
    return linear - angular * distance, linear + angular * distance

# %% name="only one number" sentence="You return one number, and the task asks for two." must_say=["two|2 values|both"] kind="type"
def wheel_speeds(linear, angular, distance):
    return linear + angular * distance / 2

# %% name="printed" sentence="You print the speeds and return nothing: write return." must_say=["return"] kind="no-return"
def wheel_speeds(linear, angular, distance):
    turn = angular * distance / 2
    print(linear - turn, linear + turn)

# %% name="names of the lesson" sentence="The names v and w are not known in the function: its arguments are linear and angular." must_say=["linear|angular|argument|name|\\bv\\b"] kind="other-cell"
def wheel_speeds(linear, angular, distance):
    half = distance / 2
    return v - w * half, v + w * half

# %% name="the example robot" sentence="You typed 0.1, which is right for the robot of the lesson only: use distance / 2." must_say=["distance", "argument|0\\.1|typed|other robots"] kind="value"
def wheel_speeds(linear, angular, distance):
    half = 0.1
    return linear - angular * half, linear + angular * half
