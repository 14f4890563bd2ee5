# %% name="tuples subtracted" sentence="Tuples cannot be subtracted: take their numbers one by one." must_say=["one by one"] kind="error"
def map_to_odom(place, counted):
    return place - counted
