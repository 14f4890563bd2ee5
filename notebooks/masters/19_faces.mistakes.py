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

# %% role="mistake" name="no zeros, uint64" says="The row and the column of zeros are missing: np.pad(sums, ((1, 0), (1, 0))). And make int64 of the image first: gray.astype(np.int64)."
def integral_image(gray):
    return running(gray, pad=0, dtype=np.uint64)

# %% role="mistake" name="in the shape of the image" says="The last row and the last column are missing: the integral image has one row and one column more than the image."
def integral_image(gray):
    return running(gray)[:-1, :-1].copy()

# %% role="mistake" name="zeros all round" says="There are zeros on all four sides. One row above and one column on the left are enough: ((1, 0), (1, 0))."
def integral_image(gray):
    return running(gray, pad=1)

# %% role="mistake" name="zeros on the left only" says="The row of zeros above is missing: pad both axes, ((1, 0), (1, 0))."
def integral_image(gray):
    return running(gray, pad=((0, 0), (1, 0)))

# %% role="mistake" name="zeros before the image as one number" says="Your zeros stand on all sides or only before one axis. np.pad needs two pairs: ((1, 0), (1, 0))."
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

# %% role="mistake" name="wraps round at 256" says="Your sums wrap round at 256, because they are uint8. Make int64 of the image first: gray.astype(np.int64)."
def integral_image(gray):
    return running(gray, dtype=np.uint8).astype(np.int64)

# %% role="mistake" name="counted twice" says="The part above and on the left is counted twice: subtract sums[r, c] once."
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
# # faces-haar

# %%
def box_sum(sums, top, left, bottom, right, signs=(1, -1, -1, 1)):
    corners = sums[bottom, right], sums[top, right], sums[bottom, left], sums[top, left]
    return sum(sign * int(corner) for sign, corner in zip(signs, corners, strict=True))

def feature(sums, boxes, row, col, total=box_sum):
    return sum(
        weight * total(sums, row + top, col + left, row + top + height, col + left + width)
        for left, top, width, height, weight in boxes
    )

# %% role="mistake" name="both exchanged" says="Rows and columns of the boxes are exchanged: top and height belong to rows, left and width to columns."
def haar_feature(sums, boxes, row, col):
    return feature(sums, [(top, left, height, width, weight) for left, top, width, height, weight in boxes], row, col)

# %% role="mistake" name="column of the window forgotten" says="You did not add col to the columns of the boxes."
def haar_feature(sums, boxes, row, col):
    return feature(sums, boxes, row, 0)

# %% role="mistake" name="row of the window forgotten" says="You did not add row to the rows of the boxes."
def haar_feature(sums, boxes, row, col):
    return feature(sums, boxes, 0, col)

# %% role="mistake" name="absolute weights" says="You use the weights without their signs. A box with the weight -1 is subtracted."
def haar_feature(sums, boxes, row, col):
    return feature(sums, [(*box[:4], abs(box[4])) for box in boxes], row, col)

# %% role="mistake" name="one row and column too many" says="Your boxes are one row and one column too large. The integral image begins with zeros, so the corner is at first_row + height, without + 1."
def haar_feature(sums, boxes, row, col):
    return feature(sums, [(left, top, w + 1, h + 1, weight) for left, top, w, h, weight in boxes], row, col)

# %% role="mistake" name="first corner too early" says="Your boxes begin one row and one column too early. The integral image begins with zeros, so use first_row and first_col without - 1."
def haar_feature(sums, boxes, row, col):
    return feature(sums, [(left - 1, top - 1, w + 1, h + 1, weight) for left, top, w, h, weight in boxes], row, col)

# %% role="mistake" name="everything moved by one" says="Your boxes are moved by one row and one column. The integral image begins with zeros, so use the corners without + 1."
def haar_feature(sums, boxes, row, col):
    return feature(sums, boxes, row + 1, col + 1)

# %% role="mistake" name="everything moved back by one" says="Your boxes are moved by one row and one column, up and to the left. This integral image begins with zeros, so use the corners without - 1."
def haar_feature(sums, boxes, row, col):
    return feature(sums, boxes, row - 1, col - 1)

# %% role="mistake" name="width is the last column" says="You took width and height for the last column and row. Add them to the first ones."
def haar_feature(sums, boxes, row, col):
    return feature(sums, [(left, top, w - left, h - top, weight) for left, top, w, h, weight in boxes], row, col)

# %% role="mistake" name="one number for each box" says="You read one number of the integral image for each box. The sum of a box needs four."
def haar_feature(sums, boxes, row, col):
    return feature(sums, boxes, row, col, lambda *box: box_sum(*box, signs=(1, 0, 0, 0)))

# %% role="mistake" name="last box only" says="Only the last box counts: your loop overwrites the value. Add with +=."
def haar_feature(sums, boxes, row, col):
    return feature(sums, boxes[-1:], row, col)

# %% role="mistake" name="weight of the last box" says="All boxes get the weight of the last one. Multiply inside the loop."
def haar_feature(sums, boxes, row, col):
    return feature(sums, [(*box[:4], boxes[-1][4]) for box in boxes], row, col)

# %% role="mistake" name="only one corner times the weight" says="Only one corner is multiplied by the weight. Put the sum of the four in parentheses."
def haar_feature(sums, boxes, row, col):
    return sum(
        box_sum(sums, row + top, col + left, row + top + height, col + left + width)
        + (weight - 1) * int(sums[row + top, col + left])
        for left, top, width, height, weight in boxes
    )

# %% [markdown]
# # faces-residue

# %%
def left_over(vector, mean, directions):
    difference = vector - mean
    return difference - (directions @ difference) @ directions

def length_of(vector):
    return float(np.sqrt((vector**2).sum()))

# %% role="mistake" name="mean not subtracted" says="Subtract the mean before you compute the weights: directions @ (vector - mean)."
def residue(vector, mean, directions):
    return length_of(vector - mean - (directions @ vector) @ directions)

# %% role="mistake" name="mean not added" says="Add the mean when you rebuild the vector: rebuilt = mean + weights @ directions."
def residue(vector, mean, directions):
    return length_of(vector - (directions @ (vector - mean)) @ directions)

# %% role="mistake" name="no root" says="You return the square of the length. Take the square root."
def residue(vector, mean, directions):
    return length_of(left_over(vector, mean, directions)) ** 2

# %% role="mistake" name="mean of the squares" says="You return the mean of the squares. The residue is the root of their sum."
def residue(vector, mean, directions):
    return length_of(left_over(vector, mean, directions)) ** 2 / len(vector)

# %% role="mistake" name="largest difference" says="You return the largest difference. The residue is the root of the sum of all squares."
def residue(vector, mean, directions):
    return float(abs(left_over(vector, mean, directions)).max())

# %% role="mistake" name="distance from the mean to the rebuilt vector without the mean" says="You compare the wrong two vectors: it is vector - rebuilt, and rebuilt has the mean in it."
def residue(vector, mean, directions):
    return length_of(mean - (directions @ (vector - mean)) @ directions)

# %% role="mistake" name="length of the rebuilt vector" says="You return the length of the rebuilt vector. The residue is the length of vector - rebuilt."
def residue(vector, mean, directions):
    return length_of(mean + (directions @ (vector - mean)) @ directions)

# %% role="mistake" name="mean subtracted again" says="Add the mean when you rebuild the vector; you subtracted it."
def residue(vector, mean, directions):
    return length_of(vector - ((directions @ (vector - mean)) @ directions - mean))

# %% role="mistake" name="last direction only" says="Only the last direction is used: your loop overwrites what it rebuilt before. Add with +=."
def residue(vector, mean, directions):
    return length_of(left_over(vector, mean, directions[-1:]))

# %% role="mistake" name="weights added up" says="You added up the weights and multiplied all directions by the sum. Each direction has its own weight: weights @ directions."
def residue(vector, mean, directions):
    return length_of(vector - mean - (directions @ (vector - mean)).sum() * directions.sum(axis=0))

# %% role="mistake" name="sum with signs" says="You added what is left over with its signs, so it cancels out. Square it first, then add, then take the root."
def residue(vector, mean, directions):
    return float(left_over(vector, mean, directions).sum())

# %% role="mistake" name="size of the sum" says="You squared the sum. Square each difference first, then add, then take the root."
def residue(vector, mean, directions):
    return abs(float(left_over(vector, mean, directions).sum()))

# %% role="mistake" name="the vector that is left over" says="You return the vector that is left over. Return its length, one number."
def residue(vector, mean, directions):
    return left_over(vector, mean, directions)

# %% role="mistake" name="the rebuilt vector" says="You return the rebuilt vector. Return the length of vector - rebuilt, one number."
def residue(vector, mean, directions):
    return mean + (directions @ (vector - mean)) @ directions

# %% role="mistake" name="the weights" says="You return the weights. Rebuild the vector from them, and return the length of what is left over."
def residue(vector, mean, directions):
    return directions @ (vector - mean)

# %% role="mistake" name="zero" says="You return 0. Is rebuilt really computed from the weights?"
def residue(vector, mean, directions):
    return 0.0

# %% role="mistake" name="the mean in each round" says="Your loop adds the mean once for each direction. Add it once: begin with rebuilt = mean, or use weights @ directions."
def residue(vector, mean, directions):
    rebuilt = len(directions) * mean + (directions @ (vector - mean)) @ directions
    return length_of(vector - rebuilt)

# %% [markdown]
# # faces-lbp

# %%
CLOCKWISE = ((-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1))

def codes_of(gray, neighbours=CLOCKWISE, answer=np.greater_equal, weights=(1, 2, 4, 8, 16, 32, 64, 128)):
    rows, cols = gray.shape
    pixels = gray[1:-1, 1:-1]
    codes = np.zeros(pixels.shape, int)
    for (down, right), weight in zip(neighbours, weights, strict=False):
        codes += weight * answer(gray[1 + down : rows - 1 + down, 1 + right : cols - 1 + right], pixels).astype(int)
    return codes.astype(np.uint8)

# %% role="mistake" name="darker neighbours" says="You ask whether the neighbour is darker. Ask whether it is at least as bright: neighbour >= pixel."
def lbp_codes(gray):
    return codes_of(gray, answer=np.less)

# %% role="mistake" name="row by row" says="You number the neighbours row by row. They go clockwise: 1, 2, 4 above, then 8 on the right, 16, 32, 64 below from right to left, and 128 on the left."
def lbp_codes(gray):
    return codes_of(gray, [(-1, -1), (-1, 0), (-1, 1), (0, -1), (0, 1), (1, -1), (1, 0), (1, 1)])

# %% role="mistake" name="from the right" says="You begin on the right. The number 1 belongs to the upper left neighbour."
def lbp_codes(gray):
    return codes_of(gray, CLOCKWISE[3:] + CLOCKWISE[:3])

# %% role="mistake" name="from the right, counter-clockwise" says="You begin on the right and go counter-clockwise, as scikit-image does. Here 1 is the upper left neighbour, and it goes clockwise."
def lbp_codes(gray):
    return codes_of(gray, CLOCKWISE[3::-1] + CLOCKWISE[:3:-1])

# %% role="mistake" name="from above" says="You begin above the pixel. The number 1 belongs to the upper left neighbour."
def lbp_codes(gray):
    return codes_of(gray, CLOCKWISE[1:] + CLOCKWISE[:1])

# %% role="mistake" name="upside down" says="Above and below are exchanged: 1, 2 and 4 are the neighbours in the row above, gray[:-2]."
def lbp_codes(gray):
    return codes_of(gray, [(-down, right) for down, right in CLOCKWISE])

# %% role="mistake" name="right and left exchanged" says="Left and right are exchanged: 8 is the neighbour on the right, gray[1:-1, 2:], and 128 the one on the left."
def lbp_codes(gray):
    return codes_of(gray, [(down, -right) for down, right in CLOCKWISE])

# %% role="mistake" name="last neighbour only" says="Only the last neighbour counts: your loop overwrites the codes. Add with +=."
def lbp_codes(gray):
    return codes_of(gray, weights=(0, 0, 0, 0, 0, 0, 0, 128))

# %% role="mistake" name="16 and 64 exchanged" says="16 and 64 are exchanged: clockwise, the lower right neighbour comes before the lower left one."
def lbp_codes(gray):
    return codes_of(gray, weights=(1, 2, 4, 8, 64, 32, 16, 128))

# %% role="mistake" name="subtracted in uint8" says="All your codes are 255: a difference of uint8 is never negative. Compare without subtracting: neighbour >= pixel."
def lbp_codes(gray):
    return np.full((gray.shape[0] - 2, gray.shape[1] - 2), 255, np.uint8)

# %% role="mistake" name="eight, not two to the power" says="Your numbers are 1, 2, 3 and so on up to 8. They are powers of two: 1, 2, 4, 8, 16, 32, 64, 128."
def lbp_codes(gray):
    return codes_of(gray, weights=range(1, 9))

# %% role="mistake" name="times the index" says="Your numbers are 0, 1, 2 and so on up to 7. They are powers of two: 2**0, 2**1, up to 2**7."
def lbp_codes(gray):
    return codes_of(gray, weights=range(8))

# %% role="mistake" name="two times the index" says="You multiply 2 by the index. It is 2 to the power of the index: 2**number."
def lbp_codes(gray):
    return codes_of(gray, weights=range(0, 16, 2))

# %% role="mistake" name="begins with 2" says="Your numbers are twice too large: the upper left neighbour adds 2**0, which is 1."
def lbp_codes(gray):
    return codes_of(gray, weights=(2, 4, 8, 16, 32, 64, 128, 0))

# %% role="mistake" name="without the last neighbour" says="The neighbour on the left, with 128, is missing. There are eight neighbours."
def lbp_codes(gray):
    return codes_of(gray, weights=(1, 2, 4, 8, 16, 32, 64))

# %% role="mistake" name="without the first neighbour" says="The upper left neighbour, with 1, is missing. There are eight neighbours."
def lbp_codes(gray):
    return codes_of(gray, weights=(0, 2, 4, 8, 16, 32, 64, 128))

# %% role="mistake" name="four neighbours" says="You use only the four straight neighbours. The four diagonal ones count too."
def lbp_codes(gray):
    return codes_of(gray, weights=(0, 2, 0, 8, 0, 32, 0, 128))

# %% role="mistake" name="border padded with zeros" says="You return a code for the outermost pixels too. They have no eight neighbours: leave them out."
def lbp_codes(gray):
    return codes_of(np.pad(gray, 1))

# %% role="mistake" name="border repeated" says="You return a code for the outermost pixels too. They have no eight neighbours: leave them out instead of repeating the border."
def lbp_codes(gray):
    return codes_of(np.pad(gray, 1, mode="edge"))

# %% role="mistake" name="border of zeros" says="Your result has a border of zeros. Leave the outermost rows and columns out: the shape is (H - 2, W - 2)."
def lbp_codes(gray):
    return np.pad(codes_of(gray), 1)

# %% role="mistake" name="compared with the mean" says="You compare with the mean of the neighbourhood. Compare with the pixel in the middle."
def lbp_codes(gray):
    rows, cols = gray.shape
    slices = [gray[i : rows - 2 + i, j : cols - 2 + j].astype(float) for i in range(3) for j in range(3)]
    mean = sum(slices) / 9
    return codes_of(gray, answer=lambda neighbour, _: neighbour >= mean)

# %% role="mistake" name="zeros" says="All your codes are 0. Do you add something where the neighbour is at least as bright?"
def lbp_codes(gray):
    return np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)

# %% role="mistake" name="always the same pixel" says="You compare all neighbours with one pixel, gray[1, 1]. Each pixel has its own neighbours: compare with gray[1:-1, 1:-1]."
def lbp_codes(gray):
    return codes_of(gray, answer=lambda neighbours, _: neighbours >= gray[1, 1])

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

# %% role="mistake" name="width and height exchanged" says="Width and height are exchanged: width counts columns, height counts rows."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(left, top, height, width) for left, top, width, height in boxes], size)

# %% role="mistake" name="width is the last column" says="You took width and height for the last column and row. The box ends at left + width and top + height."
def hide_boxes(frame, boxes, size):
    return mosaic(frame, [(left, top, width - left, height - top) for left, top, width, height in boxes], size)

# %% role="mistake" name="boxes that begin outside left out" says="You leave out a box that begins outside the image. Cut it to the image, and hide what is left."
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

# %% role="mistake" name="last blocks too large" says="Your last blocks reach over the border of the box. A block ends where its box ends: min(row + size, last_row)."
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

# %% role="mistake" name="not cut, and blocks too large" says="Two things: a box that begins outside the image stays visible (begin at max(left, 0) and max(top, 0)), and the last blocks reach over the border of the box (end at min(row + size, last_row))."
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
