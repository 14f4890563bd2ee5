# %% name="np.were" sentence="The function is called np.where." must_say=["np\\.where"] kind="error"
def binarize(gray, level):
    return np.were(gray > level, 255, 0).astype(np.uint8)
