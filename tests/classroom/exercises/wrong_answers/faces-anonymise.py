# %% name="the whole image" sentence="Only the boxes are hidden." must_say=["only the boxes"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for r in range(0, frame.shape[0], size):
        for c in range(0, frame.shape[1], size):
            result[r:r + size, c:c + size] = frame[r:r + size, c:c + size].mean(axis=(0, 1))
    return result
