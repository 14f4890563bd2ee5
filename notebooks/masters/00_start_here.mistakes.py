# %% [markdown]
# # start-count

# %% role="mistake" name="rows counted instead of pixels" says="That is only the number of rows, len(frame). Multiply it by the number of columns, frame.shape[1]."
def count_pixels(frame):
    return len(frame)

# %% role="mistake" name="rows plus columns" says="That is the sum of rows and columns. Each row has as many pixels as there are columns, so multiply the two numbers."
def count_pixels(frame):
    return frame.shape[0] + frame.shape[1]

# %% role="mistake" name="black not counted" says="Your function counts the numbers that are not 0. The values do not matter here, only the number of pixels: multiply the rows by the columns of frame.shape."
def count_pixels(frame):
    return np.count_nonzero(frame)

# %% role="mistake" name="values added up" says="That is the sum of all values in the image. The values do not matter here: count the pixels, rows × columns, with frame.shape."
def count_pixels(frame):
    return int(frame.sum())

# %% role="mistake" name="different values counted" says="That is the number of different values in the image (as np.unique finds them). Count the pixels instead: multiply the rows by the columns of frame.shape."
def count_pixels(frame):
    return np.unique(frame).size
