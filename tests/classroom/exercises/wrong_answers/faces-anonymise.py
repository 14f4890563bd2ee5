# %% name="not cut at the border" origin="new" sentence="A negative index counts from the other side: begin at max(left, 0) and max(top, 0)." must_say=["max\\(|negative|cut"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        for r in range(top, top + height, size):
            for c in range(left, left + width, size):
                block = frame[r:min(r + size, top + height), c:min(c + size, left + width)]
                if block.size:
                    result[r:min(r + size, top + height), c:min(c + size, left + width)] = block.mean(axis=(0, 1)).round()
    return result

# %% name="one colour" origin="new" sentence="Divide the box into blocks of size × size pixels." must_say=["block"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        part = result[max(top, 0):top + height, max(left, 0):left + width]
        part[:] = part.mean(axis=(0, 1)).round()
    return result

# %% name="gray" origin="new" sentence="Take the mean over rows and columns only: axis=(0, 1)." must_say=["axis=\\(0, 1\\)|gray|channel"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(max(top, 0), last_row, size):
            for c in range(max(left, 0), last_col, size):
                part = result[r:min(r + size, last_row), c:min(c + size, last_col)]
                part[:] = part.mean()
    return result

# %% name="left and top" origin="new" sentence="left and width belong to the columns, top and height to the rows." must_say=["exchanged|belong"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for top, left, height, width in boxes:
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(max(top, 0), last_row, size):
            for c in range(max(left, 0), last_col, size):
                part = result[r:min(r + size, last_row), c:min(c + size, last_col)]
                part[:] = part.mean(axis=(0, 1))
    return result

# %% name="changes the frame" origin="new" sentence="Your function changes its input: make a copy first." must_say=["copy|changed|changes"] kind="input-changed"
def hide_boxes(frame, boxes, size):
    for left, top, width, height in boxes:
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(max(top, 0), last_row, size):
            for c in range(max(left, 0), last_col, size):
                part = frame[r:min(r + size, last_row), c:min(c + size, last_col)]
                part[:] = part.mean(axis=(0, 1))
    return frame

# %% name="return inside the loop" origin="new" sentence="Only the first box is hidden: return after the loop." must_say=["first box", "return"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(max(top, 0), last_row, size):
            for c in range(max(left, 0), last_col, size):
                part = result[r:min(r + size, last_row), c:min(c + size, last_col)]
                part[:] = part.mean(axis=(0, 1))
        return result

# %% name="copy inside the loop" origin="new" sentence="Only the last box is hidden: make the copy once, before the loop." must_say=["last box", "copy"] kind="value"
def hide_boxes(frame, boxes, size):
    for left, top, width, height in boxes:
        result = frame.copy()
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(max(top, 0), last_row, size):
            for c in range(max(left, 0), last_col, size):
                part = result[r:min(r + size, last_row), c:min(c + size, last_col)]
                part[:] = part.mean(axis=(0, 1))
    return result

# %% name="blocks larger than the box" origin="new" sentence="The last block ends where the box ends." must_say=["ends|border of the box"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        for r in range(max(top, 0), min(top + height, frame.shape[0]), size):
            for c in range(max(left, 0), min(left + width, frame.shape[1]), size):
                result[r:r + size, c:c + size] = frame[r:r + size, c:c + size].mean(axis=(0, 1)).round()
    return result

# %% name="whole blocks only" origin="new" sentence="The smaller blocks at the border of the box must be hidden too." must_say=["smaller blocks|small"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        first_row, first_col = max(top, 0), max(left, 0)
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(first_row, last_row - size + 1, size):
            for c in range(first_col, last_col - size + 1, size):
                result[r:r + size, c:c + size] = frame[r:r + size, c:c + size].mean(axis=(0, 1)).round()
    return result

# %% name="first pixel of the block" origin="new" sentence="Take the mean of the block, not its first pixel." must_say=["mean", "first pixel|pixel"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(max(top, 0), last_row, size):
            for c in range(max(left, 0), last_col, size):
                result[r:min(r + size, last_row), c:min(c + size, last_col)] = frame[r, c]
    return result

# %% name="moved into the image" origin="new" sentence="Cut the box off: it ends at left + width also if left is negative." must_say=["cut"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        left, top = max(left, 0), max(top, 0)
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(top, last_row, size):
            for c in range(left, last_col, size):
                part = result[r:min(r + size, last_row), c:min(c + size, last_col)]
                part[:] = part.mean(axis=(0, 1))
    return result

# %% name="width is the end" origin="new" sentence="The box ends at left + width, not at width." must_say=["left \\+ width"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        for r in range(max(top, 0), min(height, frame.shape[0]), size):
            for c in range(max(left, 0), min(width, frame.shape[1]), size):
                part = result[r:min(r + size, height), c:min(c + size, width)]
                part[:] = part.mean(axis=(0, 1))
    return result

# %% name="axis forgotten for columns" origin="new" sentence="Take the mean over rows and columns: axis=(0, 1)." must_say=["axis=\\(0, 1\\)|broadcast|shape|mean of its pixels"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for r in range(max(top, 0), last_row, size):
            for c in range(max(left, 0), last_col, size):
                part = result[r:min(r + size, last_row), c:min(c + size, last_col)]
                part[:] = part.mean(axis=0)
    return result

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        result[max(top, 0):top + height, max(left, 0):left + width] = 0

# %% name="mean of columns" origin="walk" sentence="Take the mean over rows and columns: axis=(0, 1)." must_say=["axis=\\(0, 1\\)"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    h, w = frame.shape[:2]
    for left, top, width, height in boxes:
        r1, r2 = max(top, 0), min(top + height, h)
        c1, c2 = max(left, 0), min(left + width, w)
        for r in range(r1, r2, size):
            for c in range(c1, c2, size):
                block = result[r:min(r + size, r2), c:min(c + size, c2)]
                block[:] = block.mean(axis=0)
    return result

# %% name="divided by size squared" origin="walk" sentence="Smaller blocks are too dark: divide by the number of their own pixels." must_say=["own pixels"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    h, w = frame.shape[:2]
    for left, top, width, height in boxes:
        r1, r2 = max(top, 0), min(top + height, h)
        c1, c2 = max(left, 0), min(left + width, w)
        for r in range(r1, r2, size):
            for c in range(c1, c2, size):
                block = result[r:min(r + size, r2), c:min(c + size, c2)]
                block[:] = block.sum(axis=(0, 1)) / size ** 2
    return result

# %% name="plain gray" origin="walk" sentence="Each block gets the mean of its pixels, not 120." must_say=["mean of its pixels"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    h, w = frame.shape[:2]
    for left, top, width, height in boxes:
        r1, r2 = max(top, 0), min(top + height, h)
        c1, c2 = max(left, 0), min(left + width, w)
        for r in range(r1, r2, size):
            for c in range(c1, c2, size):
                block = result[r:min(r + size, r2), c:min(c + size, c2)]
                block[:] = 120
    return result

# %% name="one row too early" origin="walk" sentence="The last row and column of the image stay visible: no - 1." must_say=["last row"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    h, w = frame.shape[:2]
    for left, top, width, height in boxes:
        r1, r2 = max(top, 0), min(top + height, h - 1)
        c1, c2 = max(left, 0), min(left + width, w - 1)
        for r in range(r1, r2, size):
            for c in range(c1, c2, size):
                block = result[r:min(r + size, r2), c:min(c + size, c2)]
                block[:] = block.mean(axis=(0, 1))
    return result

# %% name="black image" origin="walk" sentence="Begin with a copy of the frame: all other pixels stay as they are." must_say=["copy"] kind="value"
def hide_boxes(frame, boxes, size):
    result = np.zeros_like(frame)
    h, w = frame.shape[:2]
    for left, top, width, height in boxes:
        r1, r2 = max(top, 0), min(top + height, h)
        c1, c2 = max(left, 0), min(left + width, w)
        for r in range(r1, r2, size):
            for c in range(c1, c2, size):
                block = result[r:min(r + size, r2), c:min(c + size, c2)]
                block[:] = frame[r:min(r + size, r2), c:min(c + size, c2)].mean(axis=(0, 1))
    return result

# %% name="the whole image" origin="walk" sentence="Only the boxes are hidden." must_say=["only the boxes"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for r in range(0, frame.shape[0], size):
        for c in range(0, frame.shape[1], size):
            result[r:r + size, c:c + size] = frame[r:r + size, c:c + size].mean(axis=(0, 1))
    return result

# %% name="no limits at all" origin="walk" sentence="A negative index counts from the other side: cut the box to the image, and end each block where the box ends." must_say=["max\\(|negative", "border of the box|ends"] kind="value"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        for r in range(top, top + height, size):
            for c in range(left, left + width, size):
                result[r:r + size, c:c + size] = frame[r:r + size, c:c + size].mean(axis=(0, 1))
    return result
