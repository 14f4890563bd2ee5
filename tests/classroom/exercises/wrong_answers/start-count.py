# %% name="no parameter, global frame" sentence="Your function takes no argument, but it is called with a frame: write count_pixels(frame) and use that parameter, not the frame of another cell." must_say=["argument|parameter|takes no|takes 0", "count_pixels\\(frame\\)|no (argument|parameter)|takes (no|0)|without|parenthes|missing"] must_not_say=["define frame"] kind="error"
def count_pixels():
    return frame.shape[0] * frame.shape[1]

# %% name="function renamed" sentence="The exercise needs a function with the name count_pixels, and this cell defines countpixels: use the name of the task." must_say=["countpixels|\\bnames?\\b|renam|spell", "count_pixels"] kind="other-name"
def countpixels(frame):
    return frame.shape[0] * frame.shape[1]

# %% name="rows and columns as a tuple" sentence="You return two numbers, the rows and the columns, as a tuple: the task asks for one number, so multiply them." must_say=["tuple|pair|returns? (two|both)|two (numbers|values) came", "multipl|one (whole )?number|product"] kind="type"
def count_pixels(frame):
    return frame.shape[0], frame.shape[1]
