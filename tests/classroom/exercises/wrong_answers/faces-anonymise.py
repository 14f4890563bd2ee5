# %% name="the whole image" sentence="Only the boxes are hidden." must_say=["only the boxes"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for r in range(0, frame.shape[0], size):
        for c in range(0, frame.shape[1], size):
            result[r:r + size, c:c + size] = frame[r:r + size, c:c + size].mean(axis=(0, 1))
    return result

# %% name="only the parts" sentence="Return the whole image, and not the hidden part." must_say=["whole image"] kind="shape"
def hide_boxes(frame, boxes, size):
    for left, top, width, height in boxes:
        part = frame[max(top, 0):top + height, max(left, 0):left + width].copy()
        rows, cols = part.shape[:2]
        for r in range(0, rows, size):
            for c in range(0, cols, size):
                part[r:r + size, c:c + size] = part[r:r + size, c:c + size].mean(axis=(0, 1)).round()
    return part

# %% name="no limits at all" sentence="A negative index counts from the other side: cut the box to the image, and end each block where the box ends." must_say=["max\\(|negative", "border of the box|ends"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        for r in range(top, top + height, size):
            for c in range(left, left + width, size):
                result[r:r + size, c:c + size] = frame[r:r + size, c:c + size].mean(axis=(0, 1))
    return result
