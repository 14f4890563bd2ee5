# %% name="mean of each box" origin="fresh" sentence="Take the sum of each box, and not its mean." must_say=["sum"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        total = sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c]
        value += weight * total / (width * height)
    return value

# %% name="sign only" origin="fresh" sentence="Multiply by the weight itself, not only by its sign." must_say=["weight"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        total = sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c]
        if weight > 0:
            value += total
        else:
            value -= total
    return value

# %% name="two corners" origin="fresh" sentence="Two corners are not enough: a box needs four numbers." must_say=["four|two corners|corner"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        value += weight * (sums[r + height, c + width] - sums[r, c])
    return value

# %% name="col for both" origin="fresh" sentence="Add row to the rows and col to the columns." must_say=["row", "col"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = col + top, col + left
        value += weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c])
    return value

# %% name="box is not unpacked" origin="fresh" sentence="A box has five numbers: left, top, width, height and weight." must_say=["five|unpack|5"] kind="error"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height in boxes:
        r, c = row + top, col + left
        value += sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c]
    return value
