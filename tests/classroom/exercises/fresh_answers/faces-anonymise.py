# %% name="blocks of the image" origin="fresh" sentence="The blocks begin at the corner of the box, not of the image." must_say=["begin"] kind="value"
def hide_boxes(frame, boxes, size):
    small = frame.copy()
    for r in range(0, frame.shape[0], size):
        for c in range(0, frame.shape[1], size):
            small[r:r + size, c:c + size] = frame[r:r + size, c:c + size].mean(axis=(0, 1)).round()
    result = frame.copy()
    for left, top, width, height in boxes:
        part = np.s_[max(top, 0):top + height, max(left, 0):left + width]
        result[part] = small[part]
    return result

# %% name="skips boxes outside" origin="fresh" sentence="Cut a box that reaches over the border, and hide what is left of it." must_say=["cut"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        if left < 0 or top < 0 or left + width > frame.shape[1] or top + height > frame.shape[0]:
            continue
        for r in range(top, top + height, size):
            for c in range(left, left + width, size):
                part = result[r:min(r + size, top + height), c:min(c + size, left + width)]
                part[:] = part.mean(axis=(0, 1))
    return result

# %% name="median" origin="fresh" sentence="Take the mean, not the median." must_say=["median"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(max(top, 0), last_row, size):
            for c in range(max(left, 0), last_col, size):
                part = result[r:min(r + size, last_row), c:min(c + size, last_col)]
                part[:] = np.median(part, axis=(0, 1))
    return result

# %% name="black" origin="fresh" sentence="Each block gets its mean; it is not black." must_say=["mean"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        result[max(top, 0):top + height, max(left, 0):left + width] = 0
    return result

# %% name="only the parts" origin="fresh" sentence="Return the whole image, and not the hidden part." must_say=["whole image"] kind="shape"
def hide_boxes(frame, boxes, size):
    for left, top, width, height in boxes:
        part = frame[max(top, 0):top + height, max(left, 0):left + width].copy()
        rows, cols = part.shape[:2]
        for r in range(0, rows, size):
            for c in range(0, cols, size):
                part[r:r + size, c:c + size] = part[r:r + size, c:c + size].mean(axis=(0, 1)).round()
    return part
