# %% name="attributes" sentence="A box is a tuple of four numbers: a[2], not a.width." must_say=["tuple|attribute|index|\\["] kind="error"
def iou(a, b):
    both = max(0, min(a.right, b.right) - max(a.left, b.left))
    return both / (a.area + b.area - both)

# %% name="True or False" sentence="Return the IoU itself, not whether the boxes touch." must_say=["IoU|number|True"] kind="type"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both > 0
