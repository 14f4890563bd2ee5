# %% name="attributes" sentence="A box is a tuple of four numbers: a[2], not a.width." must_say=["tuple|attribute|index|\\["] kind="error"
def iou(a, b):
    both = max(0, min(a.right, b.right) - max(a.left, b.left))
    return both / (a.area + b.area - both)

# %% name="no max" sentence="The common width and height can be negative: use max(..., 0) for each." must_say=["max|negative"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = width * height
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    print(both / (a[2] * a[3] + b[2] * b[3] - both))

# %% name="True or False" sentence="Return the IoU itself, not whether the boxes touch." must_say=["IoU|number|True"] kind="type"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both > 0

# %% name="sum of the areas" sentence="The sum counts the intersection twice: subtract it." must_say=["twice|subtract|intersection|union"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3])
