# %% name="no parameter, global frame" sentence="Your function takes no argument, but it is called with a frame: write count_pixels(frame) and use that parameter, not the frame of another cell." must_say=["argument|parameter|takes no|takes 0", "count_pixels\\(frame\\)|no (argument|parameter)|takes (no|0)|without|parenthes|missing"] must_not_say=["define frame"] kind="error"
def count_pixels():
    return frame.shape[0] * frame.shape[1]

# %% name="function renamed" sentence="The exercise needs a function with the name count_pixels, and this cell defines countpixels: use the name of the task." must_say=["countpixels|\\bnames?\\b|renam|spell", "count_pixels"] kind="other-name"
def countpixels(frame):
    return frame.shape[0] * frame.shape[1]
