# %% name="the whole distance" sentence="A wheel is only half the distance away from the centre: use distance / 2." must_say=["half|/ ?2"] kind="value"
def wheel_speeds(linear, angular, distance):
    return linear - angular * distance, linear + angular * distance

# %% name="only one number" sentence="You return one number, and the task asks for two." must_say=["two|2 values|both"] kind="type"
def wheel_speeds(linear, angular, distance):
    return linear + angular * distance / 2
