# %% [markdown]
# # start-count

# %% role="mistake" name="rows counted instead of pixels" says="That is only the number of rows, len(frame). Multiply it by the number of columns, frame.shape[1]."
def count_pixels(frame):
    return len(frame)

# %% role="mistake" name="columns counted instead of pixels" says="That is only the number of columns: the pixels of one row. Count the pixels of all rows. If you use a loop, return must stand below the loop; a return inside it ends the function in the first row."
def count_pixels(frame):
    return frame.shape[1]

# %% role="mistake" name="rows plus columns" says="That is the sum of rows and columns. Each row has as many pixels as there are columns, so multiply the two numbers."
def count_pixels(frame):
    return frame.shape[0] + frame.shape[1]

# %% role="mistake" name="columns times channels" says="That is columns × channels. Python counts from 0: the rows are frame.shape[0], the columns are frame.shape[1], and frame.shape[2] is the number of channels."
def count_pixels(frame):
    return frame.shape[1] * frame.shape[2]

# %% role="mistake" name="rows times channels" says="That is rows × channels. Python counts from 0: the rows are frame.shape[0], the columns are frame.shape[1], and frame.shape[2] is the number of channels."
def count_pixels(frame):
    return frame.shape[0] * frame.shape[2]

# %% role="mistake" name="rows times rows" says="That is rows × rows. The columns are the second number of the shape: frame.shape[1]."
def count_pixels(frame):
    return frame.shape[0] * frame.shape[0]

# %% role="mistake" name="the last row and column not counted" says="One row and one column are missing in the result. If you use loops: range(n) already stops before n, so write range(rows) and range(columns), without - 1."
def count_pixels(frame):
    return (frame.shape[0] - 1) * (frame.shape[1] - 1)

# %% role="mistake" name="black not counted" says="Your function counts the numbers that are not 0. The values do not matter here, only the number of pixels: multiply the rows by the columns of frame.shape."
def count_pixels(frame):
    return np.count_nonzero(frame)

# %% role="mistake" name="values added up" says="That is the sum of all values in the image. The values do not matter here: count the pixels, rows × columns, with frame.shape."
def count_pixels(frame):
    return int(frame.sum())

# %% role="mistake" name="different values counted" says="That is the number of different values in the image (as np.unique finds them). Count the pixels instead: multiply the rows by the columns of frame.shape."
def count_pixels(frame):
    return np.unique(frame).size
