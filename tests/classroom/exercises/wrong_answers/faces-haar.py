# %% name="window forgotten" origin="new" sentence="Add row and col of the window to the corners of the box." must_say=["row", "col"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        total = sums[top + height, left + width] - sums[top, left + width] - sums[top + height, left] + sums[top, left]
        value += weight * total
    return value

# %% name="row and col exchanged" origin="new" sentence="row belongs to top, and col to left." must_say=["exchanged|belongs"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = col + top, row + left
        value += weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c])
    return value

# %% name="top first" origin="new" sentence="left comes first in a box, then top." must_say=["left and top|left"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for top, left, width, height, weight in boxes:
        r, c = row + top, col + left
        value += weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c])
    return value

# %% name="height first" origin="new" sentence="width comes before height: width counts columns." must_say=["width"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, height, width, weight in boxes:
        r, c = row + top, col + left
        value += weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c])
    return value

# %% name="x, y order" origin="new" sentence="It is sums[row, column]: the row comes first." must_say=["row"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        x, y = col + left, row + top
        value += weight * (sums[x + width, y + height] - sums[x + width, y] - sums[x, y + height] + sums[x, y])
    return value

# %% name="no weight" origin="new" sentence="Multiply the sum of each box by its weight." must_say=["weight"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        value += sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c]
    return value

# %% name="fourth corner missing" origin="new" sentence="The corner above and left was subtracted twice: add it once." must_say=["corner", "add"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        value += weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c])
    return value

# %% name="fourth corner subtracted" origin="new" sentence="Add the corner above and left: it was subtracted twice." must_say=["add"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        value += weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] - sums[r, c])
    return value

# %% name="minus one" origin="new" sentence="The integral image begins with zeros, so the corner is at first + height, without - 1." must_say=["- 1|too small|zeros"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        b, e = r + height - 1, c + width - 1
        value += weight * (sums[b, e] - sums[r, e] - sums[b, c] + sums[r, c])
    return value

# %% name="from the book, with - 1" origin="new" sentence="This integral image begins with a row and a column of zeros: use first_row and first_col without - 1." must_say=["- 1|zeros"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        b, e = r + height - 1, c + width - 1
        value += weight * (sums[b, e] - sums[r - 1, e] - sums[b, c - 1] + sums[r - 1, c - 1])
    return value

# %% name="slice summed" origin="new" sentence="The integral image holds sums already: take its four corners, and do not add up a part of it." must_say=["four|corners"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        value += weight * sums[row + top:row + top + height, col + left:col + left + width].sum()
    return value

# %% name="return in the loop" origin="new" sentence="return is inside the loop, so only the first box counts." must_say=["first box", "return"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        value += weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c])
        return value

# %% name="overwritten" origin="new" sentence="The value is overwritten: add with +=." must_say=["last box|\\+="] kind="value"
def haar_feature(sums, boxes, row, col):
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        value = weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c])
    return value

# %% name="list" origin="new" sentence="Add the values of all boxes: return one number." must_say=["add|one number"] kind="type"
def haar_feature(sums, boxes, row, col):
    values = []
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        values.append(weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c]))
    return values

# %% name="row twice" origin="new" sentence="The window is added to the first row only: the last row is first_row + height." must_say=["row|window|col"] kind="value"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        b, e = top + height, left + width
        value += weight * (sums[b, e] - sums[r, e] - sums[b, c] + sums[r, c])
    return value
