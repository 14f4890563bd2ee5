# %% name="slice summed" sentence="The integral image holds sums already: take its four corners, and do not add up a part of it." must_say=["four|corners"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        value += weight * sums[row + top:row + top + height, col + left:col + left + width].sum()
    return value

# %% name="box is not unpacked" sentence="A box has five numbers: left, top, width, height and weight." must_say=["five|unpack|5"] kind="error"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height in boxes:
        r, c = row + top, col + left
        value += sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c]
    return value

# %% name="list" sentence="Add the values of all boxes: return one number." must_say=["add|one number"] kind="type"
def haar_feature(sums, boxes, row, col):
    values = []
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        values.append(weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c]))
    return values

# %% name="overwritten" sentence="The value is overwritten: add with +=." must_say=["last box|\\+="] kind="value"
def haar_feature(sums, boxes, row, col):
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        value = weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c])
    return value

# %% name="from the book, with - 1" sentence="This integral image begins with a row and a column of zeros: use first_row and first_col without - 1." must_say=["- 1|zeros"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        b, e = r + height - 1, c + width - 1
        value += weight * (sums[b, e] - sums[r - 1, e] - sums[b, c - 1] + sums[r - 1, c - 1])
    return value
