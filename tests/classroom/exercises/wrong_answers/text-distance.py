# %% name="sets" sentence="The order of the letters counts, not only which letters there are." must_say=["order"] kind="value"
def edit_distance(a, b):
    return len(set(a) - set(b)) + len(set(b) - set(a))
