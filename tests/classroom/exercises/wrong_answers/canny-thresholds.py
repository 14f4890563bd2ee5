# %% name="0 and 255 instead of bool" sentence="You return 0 and 255, and the task asks for bool arrays: a comparison such as thinned > high is one already." must_say=["255|uint8|dtype", "bool|True"] must_not_say=["strictly above"] kind="dtype"
def double_threshold(thinned, low, high):
    strong = np.where(thinned > high, 255, 0).astype(np.uint8)
    weak = np.where((thinned > low) & (thinned <= high), 255, 0).astype(np.uint8)
    return weak, strong
