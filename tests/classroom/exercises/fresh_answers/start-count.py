# %% name="adds rows and columns" origin="fresh" sentence="The number of pixels is rows times columns; you add them." must_say=["times|multipl|×|\\*|product|add|plus|sum"] must_not_say=["channel"] kind="value"
def count_pixels(frame):
    height = frame.shape[0]
    width = frame.shape[1]
    return height + width

# %% name="sum of a pixel list" origin="fresh" sentence="You add the values of the pixels; the number of pixels is the number of rows times the number of columns." must_say=["shape|rows? (times|×|\\*)|values?|gray levels?|add|sum"] must_not_say=["channels are counted|three times"] kind="value"
def count_pixels(frame):
    number = 0
    for row in frame:
        for pixel in row:
            number = number + pixel[0]
    return int(number)

# %% name="index one too far" origin="fresh" sentence="The shape (rows, columns, 3) has the indices 0, 1 and 2: rows are shape[0], columns shape[1]; your shape[3] does not exist." must_say=["indices|shape\\[|(from|with|at) 0|index [0-3]"] kind="error"
def count_pixels(frame):
    rows = frame.shape[1]
    columns = frame.shape[2]
    channels = frame.shape[3]
    return rows * columns

# %% name="shape read from a channel of columns" origin="fresh" sentence="shape[1] is the number of columns and shape[2] the number of channels; rows times columns is shape[0] * shape[1]." must_say=["shape\\[|channels?|rows"] kind="value"
def count_pixels(frame):
    return frame.shape[1] * frame.shape[2]

# %% name="calls the shape" origin="fresh" sentence="shape is no function but a tuple: write it without parentheses, frame.shape." must_say=["parenthes|tuple|not callable|no function|not a function|brackets"] kind="error"
def count_pixels(frame):
    rows, columns, channels = frame.shape()
    return rows * columns
