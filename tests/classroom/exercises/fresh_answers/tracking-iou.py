# %% name="abs instead of max" origin="fresh" sentence="abs makes boxes that do not touch overlap: use max(..., 0)." must_say=["abs|max|touch|negative"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = abs(width) * abs(height)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="only one max" origin="fresh" sentence="The height can be negative too: use max for both." must_say=["max|height|negative"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * height
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% name="plus the intersection" origin="fresh" sentence="Subtract the intersection from the sum of the areas; you added it." must_say=["subtract|minus|add"] kind="value"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3] + both)

# %% name="True or False" origin="fresh" sentence="Return the IoU itself, not whether the boxes touch." must_say=["IoU|number|True"] kind="type"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both > 0

# %% name="None for no overlap" origin="fresh" sentence="Boxes that do not touch have the IoU 0: return 0.0, not None." must_say=["0|None"] kind="type"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    if both == 0:
        return None
    return both / (a[2] * a[3] + b[2] * b[3] - both)
