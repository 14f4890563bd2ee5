# %% name="at least instead of above" sentence="You use >=, and the thresholds mean strictly above: write >." must_say=[">=|strict|at least|equal", "strict|above|write >|use >|not >="] must_not_say=["swap", "bool"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned >= high
    return (thinned >= low) & ~strong, strong

# %% name="strong minus weak" sentence="Masks cannot be subtracted: write above_low & ~strong." must_say=["~"] kind="error"
def double_threshold(thinned, low, high):
    above_low = thinned > low
    strong = thinned > high
    return above_low - strong, strong

# %% name="0 and 255 instead of bool" sentence="You return 0 and 255, and the task asks for bool arrays: a comparison such as thinned > high is one already." must_say=["255|uint8|dtype", "bool|True"] must_not_say=["strictly above"] kind="dtype"
def double_threshold(thinned, low, high):
    strong = np.where(thinned > high, 255, 0).astype(np.uint8)
    weak = np.where((thinned > low) & (thinned <= high), 255, 0).astype(np.uint8)
    return weak, strong

# %% name="not for ~" sentence="Python reads `not` only before a whole condition: between arrays write & ~strong." must_say=["~"] must_not_say=["order"] kind="syntax"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = thinned > low & not strong
    return weak, strong

# %% name="only the strong mask" sentence="You return the strong mask alone; the task asks for both, weak and strong, in this order." must_say=["alone|only (the strong|one)|one (array|mask)|single (array|mask)", "both|two|weak|pair"] kind="type"
def double_threshold(thinned, low, high):
    return thinned > high
