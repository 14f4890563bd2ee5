# %% name="no max" origin="new" sentence="The common width and height can be negative: use max(..., 0) for each." must_say=["max|negative"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = width * height
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="max of the product" origin="new" sentence="Two negative numbers have a positive product: max belongs to width and height." must_say=["max|negative"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width * height, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="sum of the areas" origin="new" sentence="The sum counts the intersection twice: subtract it." must_say=["twice|subtract|intersection|union"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3])

# %% name="over the first area" origin="new" sentence="Divide by the union, not by the area of the first box." must_say=["union"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3])

# %% name="over the smaller area" origin="new" sentence="Divide by the union, not by the smaller area." must_say=["union"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / min(a[2] * a[3], b[2] * b[3])

# %% name="the box around both" origin="new" sentence="The union is not the box around both: it is both areas minus the intersection." must_say=["union|around|minus"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    width = max(a[0] + a[2], b[0] + b[2]) - min(a[0], b[0])
    height = max(a[1] + a[3], b[1] + b[3]) - min(a[1], b[1])
    return both / (width * height)

# %% name="intersection only" origin="new" sentence="This is the area of the intersection: divide it by the union." must_say=["union|divide"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both

# %% name="corners instead of sizes" origin="new" sentence="A box is (col, row, width, height): the right end is col + width, not the third number." must_say=["width|end|size"] kind="value"
def iou(a, b):
    width = min(a[2], b[2]) - max(a[0], b[0])
    height = min(a[3], b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="percent" origin="new" sentence="Return a number from 0 to 1, not percent." must_say=["percent|100|0 to 1"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return 100 * both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="one more pixel" origin="new" sentence="Do not add 1: the end minus the start is the number of pixels." must_say=["1|pixel"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width + 1, 0) * max(height + 1, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="min and max exchanged" origin="new" sentence="The intersection goes from the larger start to the smaller end: min and max are exchanged." must_say=["min|max|exchang|intersection|smaller|larger"] kind="value"
def iou(a, b):
    width = max(a[0] + a[2], b[0] + b[2]) - min(a[0], b[0])
    height = max(a[1] + a[3], b[1] + b[3]) - min(a[1], b[1])
    both = width * height
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="whole division" origin="new" sentence="// gives a whole number: divide with /." must_say=["/|whole"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both // (a[2] * a[3] + b[2] * b[3] - both)

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    print(both / (a[2] * a[3] + b[2] * b[3] - both))

# %% name="attributes" origin="new" sentence="A box is a tuple of four numbers: a[2], not a.width." must_say=["tuple|attribute|index|\\["] kind="error"
def iou(a, b):
    both = max(0, min(a.right, b.right) - max(a.left, b.left))
    return both / (a.area + b.area - both)

# %% name="width taken as the end" origin="new" sentence="a[2] is the width: the right end is a[0] + a[2]." must_say=["width", "end", "a\\[0\\] \\+ a\\[2\\]"] kind="value"
def iou(a, b):
    width = min(a[2], b[2]) - max(a[0], b[0])
    height = min(a[3], b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="width taken as the end, in the areas too" origin="new" sentence="a[2] is the width: the right end is a[0] + a[2], and the area a[2] * a[3]." must_say=["width", "end", "area"] kind="value"
def iou(a, b):
    width = max(min(a[2], b[2]) - max(a[0], b[0]), 0)
    height = max(min(a[3], b[3]) - max(a[1], b[1]), 0)
    both = width * height
    area_a = (a[2] - a[0]) * (a[3] - a[1])
    area_b = (b[2] - b[0]) * (b[3] - b[1])
    return both / (area_a + area_b - both)
