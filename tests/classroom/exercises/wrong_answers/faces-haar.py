# %% name="list" sentence="Add the values of all boxes: return one number." must_say=["add|one number"] kind="type"
def haar_feature(sums, boxes, row, col):
    values = []
    for left, top, width, height, weight in boxes:
        r, c = row + top, col + left
        values.append(weight * (sums[r + height, c + width] - sums[r, c + width] - sums[r + height, c] + sums[r, c]))
    return values
