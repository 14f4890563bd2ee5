# %% [markdown]
# # faces-integral

# %%
def running(gray, axes=(0, 1), pad=((1, 0), (1, 0)), dtype=np.int64):
    sums = gray.astype(dtype)
    for axis in axes:
        sums = sums.cumsum(axis=axis, dtype=dtype)
    return np.pad(sums, pad)

# %% role="mistake" name="no zeros" says="The row and the column of zeros are missing: np.pad(sums, ((1, 0), (1, 0)))."
def integral_image(gray):
    return running(gray, pad=0)

# %% role="mistake" name="in the shape of the image" says="The last row and the last column are missing: the integral image has one row and one column more than the image."
def integral_image(gray):
    return running(gray)[:-1, :-1].copy()

# %% role="mistake" name="zeros all round" says="There are zeros on all four sides. One row above and one column on the left are enough: ((1, 0), (1, 0))."
def integral_image(gray):
    return running(gray, pad=1)

# %% role="mistake" name="zeros on the left only" says="The row of zeros above is missing: pad both axes, ((1, 0), (1, 0))."
def integral_image(gray):
    return running(gray, pad=((0, 0), (1, 0)))

# %% role="mistake" name="two rows of zeros" says="Two rows and two columns of zeros stand before your sums. One of each is enough, ((1, 0), (1, 0)): pad once."
def integral_image(gray):
    return np.pad(running(gray, pad=0), ((2, 0), (2, 0)))

# %% role="mistake" name="down the columns only, no zeros" says="You added down the columns only. Then add along the rows too, and put zeros above and on the left."
def integral_image(gray):
    return running(gray, axes=(0,), pad=0)

# %% role="mistake" name="along the rows only, no zeros" says="You added along the rows only. Then add down the columns too, and put zeros above and on the left."
def integral_image(gray):
    return running(gray, axes=(1,), pad=0)

# %% role="mistake" name="twice down the columns" says="You added down the columns twice. One of the two running sums goes along the rows: axis=1."
def integral_image(gray):
    return running(gray, axes=(0, 0))

# %% role="mistake" name="wraps round at 256" says="Your sums wrap round at 256, because they are uint8. Use gray.astype(np.int64) first, and np.int64 for an array of zeros, too."
def integral_image(gray):
    return running(gray, dtype=np.uint8).astype(np.int64)

# %% role="mistake" name="counted twice" says="The part above and on the left is in both sums that you add, the one of the rows above and the one on the left: subtract it once."
def integral_image(gray):
    sums = np.zeros((gray.shape[0] + 1, gray.shape[1] + 1), np.int64)
    for r, c in np.ndindex(gray.shape):
        sums[r + 1, c + 1] = int(gray[r, c]) + sums[r, c + 1] + sums[r + 1, c]
    return sums

# %% role="mistake" name="rows and columns added" says="You add all rows above and all columns on the left. Only pixels that are above and on the left at once belong to the sum: gray[:r, :c]."
def integral_image(gray):
    sums = running(gray)
    return sums[:, -1:] + sums[-1:]

# %% [markdown]
# # faces-anonymise

# %%
def blocks_of(shape, box, size, cut=True):
    """Slices of the blocks of one box."""
    left, top, width, height = box
    first_row, first_col = max(top, 0), max(left, 0)
    last_row, last_col = min(top + height, shape[0]), min(left + width, shape[1])
    for row in range(first_row, last_row, size):
        for col in range(first_col, last_col, size):
            ends = (min(row + size, last_row), min(col + size, last_col)) if cut else (row + size, col + size)
            yield slice(row, ends[0]), slice(col, ends[1])

def mosaic(frame, boxes, size, colour=lambda block: block.mean(axis=(0, 1)), cut=True):
    result = frame.copy()
    for box in boxes:
        for block in blocks_of(frame.shape, box, size, cut):
            result[block] = np.round(colour(frame[block]))
    return result

# %% role="mistake" name="left and top exchanged" says="left and top are exchanged: left and width belong to the columns, top and height to the rows."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(top, left, height, width) for left, top, width, height in boxes], size)

# %% role="mistake" name="only left and top exchanged" says="left and top are exchanged: a box is (left, top, width, height), and left is a column."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(top, left, width, height) for left, top, width, height in boxes], size)

# %% role="mistake" name="width and height exchanged" says="Width and height are exchanged: width counts columns, height counts rows."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(left, top, height, width) for left, top, width, height in boxes], size)

# %% role="mistake" name="width is the last column" says="You took width and height for the last column and row. The box ends at left + width and top + height."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(left, top, width - left, height - top) for left, top, width, height in boxes], size)

# %% role="mistake" name="boxes that begin outside left out" says="A box that begins outside the image stays visible (an index below 0 counts from the other side). Cut it to the image, and hide what is left."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [b for b in boxes if b[0] >= 0 and b[1] >= 0], size)

# %% role="mistake" name="blocks begin outside" says="Your blocks begin at the corner outside the image. Cut the box to the image first; its blocks begin there."
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        for row in range(top, top + height, size):
            for col in range(left, left + width, size):
                rows = slice(max(row, 0), max(min(row + size, top + height), 0))
                cols = slice(max(col, 0), max(min(col + size, left + width), 0))
                if frame[rows, cols].size:
                    result[rows, cols] = np.round(frame[rows, cols].mean(axis=(0, 1)))
    return result

# %% role="mistake" name="last blocks too large" says="Your last blocks reach over the border of the box. A block ends where its box ends: min(row + size, top + height)."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, boxes, size, cut=False)

# %% role="mistake" name="small blocks left out" says="The smaller blocks at the right and lower border of a box are missing. They must be hidden too."
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for box in boxes:
        for block in blocks_of(frame.shape, box, size):
            if frame[block].shape[:2] == (size, size):
                result[block] = np.round(frame[block].mean(axis=(0, 1)))
    return result

# %% role="mistake" name="blocks of the whole image" says="Your blocks begin at the corner of the image. They begin at the upper left corner of each box."
def hide_boxes(frame, boxes, size):
    whole = mosaic(frame, [(0, 0, frame.shape[1], frame.shape[0])], size)
    result = frame.copy()
    for box in boxes:
        for block in blocks_of(frame.shape, box, 1):
            result[block] = whole[block]
    return result

# %% role="mistake" name="the whole image" says="The whole image is a mosaic. Only the boxes are hidden; all other pixels stay as they are."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(0, 0, frame.shape[1], frame.shape[0])], size)

# %% role="mistake" name="not cut, and blocks too large" says="Two things: a box that begins outside the image is not all hidden (begin at max(left, 0) and max(top, 0)), and the last blocks reach over the border of the box (end at min(row + size, top + height))."
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        for row in range(top, top + height, size):
            for col in range(left, left + width, size):
                block = frame[row : row + size, col : col + size]
                if block.size:
                    result[row : row + size, col : col + size] = np.round(block.mean(axis=(0, 1)))
    return result

# %% role="mistake" name="divided by size squared" says="Smaller blocks at the border are too dark. Divide by the number of their own pixels, or use .mean(axis=(0, 1))."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, boxes, size, lambda block: block.sum(axis=(0, 1)) / size**2)

# %% role="mistake" name="a block from each pixel" says="Your blocks overlap: each begins one pixel after the one before. Steps of size: range(first, last, size)."
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        last_row, last_col = min(top + height, frame.shape[0]), min(left + width, frame.shape[1])
        for row in range(max(top, 0), last_row):
            for col in range(max(left, 0), last_col):
                part = np.s_[row : min(row + size, last_row), col : min(col + size, last_col)]
                result[part] = np.round(frame[part].mean(axis=(0, 1)))
    return result

# %% role="mistake" name="number of blocks" says="You took size for the number of blocks. It is the side of a block, in pixels."
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        rows = min(top + height, frame.shape[0]) - max(top, 0)
        cols = min(left + width, frame.shape[1]) - max(left, 0)
        tall, wide = max(rows // size, 1), max(cols // size, 1)
        for i in range(0, rows, tall):
            for j in range(0, cols, wide):
                first_row, first_col = max(top, 0) + i, max(left, 0) + j
                part = np.s_[first_row : first_row + min(tall, rows - i), first_col : first_col + min(wide, cols - j)]
                result[part] = np.round(frame[part].mean(axis=(0, 1)))
    return result

# %% role="mistake" name="plain gray" says="Your boxes are plain gray. Each block gets the mean of its pixels, for each channel."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, boxes, size, lambda block: np.full(3, 120.0))

# %% role="mistake" name="first pixel" says="Each block gets the colour of its first pixel. Take the mean of its pixels."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, boxes, size, lambda block: block[0, 0])

# %% role="mistake" name="median" says="Each block gets the median of its pixels. Take the mean."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, boxes, size, lambda block: np.median(block, axis=(0, 1)))

# %% role="mistake" name="only the first block" says="Only the first block of each box is hidden. Go through all of them with range(first, last, size), for rows and for columns."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(max(left, 0), max(top, 0), min(size, width + min(left, 0)), min(size, height + min(top, 0))) for left, top, width, height in boxes], size)

# %% role="mistake" name="only the diagonal blocks" says="Only the blocks on the diagonal are hidden. Use a loop over the columns inside the loop over the rows."
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for box in boxes:
        left, top = max(box[0], 0), max(box[1], 0)
        for block in blocks_of(frame.shape, box, size):
            if block[0].start - top == block[1].start - left:
                result[block] = np.round(frame[block].mean(axis=(0, 1)))
    return result

# %% role="mistake" name="one pixel larger" says="Your boxes are one row and one column too large: they end before top + height and left + width."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(left, top, width + 1, height + 1) for left, top, width, height in boxes], size)

# %% role="mistake" name="one pixel smaller" says="Your boxes are one row and one column too small: the last row is top + height - 1, and a slice ends after it."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(left, top, width - 1, height - 1) for left, top, width, height in boxes], size)

# %% role="mistake" name="outside hidden" says="You hid everything outside the boxes. Hide what is inside them."
def hide_boxes(frame, boxes, size):
    result = np.zeros_like(frame)
    for box in boxes:
        for block in blocks_of(frame.shape, box, 1):
            result[block] = frame[block]
    return result

# %% role="mistake" name="only the face" says="You return the hidden part alone. Return the whole image, with all other pixels as they were."
def hide_boxes(frame, boxes, size):
    left, top, width, height = boxes[-1]
    whole = mosaic(frame, boxes, size)
    return whole[max(top, 0) : top + height, max(left, 0) : left + width].copy()
