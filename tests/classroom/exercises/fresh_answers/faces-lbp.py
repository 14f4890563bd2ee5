# %% name="straight neighbours" origin="fresh" sentence="The diagonal neighbours count too." must_say=["diagonal"] kind="value"
def lbp_codes(gray):
    c = gray[1:-1, 1:-1]
    codes = 2 * (gray[:-2, 1:-1] >= c) + 8 * (gray[1:-1, 2:] >= c)
    codes = codes + 32 * (gray[2:, 1:-1] >= c) + 128 * (gray[1:-1, :-2] >= c)
    return codes.astype(np.uint8)

# %% name="1 to 8" origin="fresh" sentence="The numbers are powers of two." must_say=["power"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for k, (dr, dc) in enumerate(order, start=1):
        moved = gray[1 + dr:gray.shape[0] - 1 + dr, 1 + dc:gray.shape[1] - 1 + dc]
        codes += (k * (moved >= gray[1:-1, 1:-1])).astype(np.uint8)
    return codes

# %% name="compared with the mean" origin="fresh" sentence="Compare with the pixel in the middle, and not with the mean." must_say=["mean"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for r in range(1, gray.shape[0] - 1):
        for c in range(1, gray.shape[1] - 1):
            mean = gray[r - 1:r + 2, c - 1:c + 2].mean()
            for k, (dr, dc) in enumerate(order):
                if gray[r + dr, c + dc] >= mean:
                    codes[r - 1, c - 1] += 2 ** k
    return codes

# %% name="upside down" origin="fresh" sentence="Above and below are exchanged: row -1 is above." must_say=["above"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    order = [(1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1)]
    for k, (dr, dc) in enumerate(order):
        moved = gray[1 + dr:gray.shape[0] - 1 + dr, 1 + dc:gray.shape[1] - 1 + dc]
        codes += (moved >= gray[1:-1, 1:-1]).astype(np.uint8) << k
    return codes

# %% name="one list of codes" origin="fresh" sentence="Return an array with two rows and two columns less than the image, not one long list." must_say=["array|list|shape"] kind="shape"
def lbp_codes(gray):
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    codes = []
    for r in range(1, gray.shape[0] - 1):
        for c in range(1, gray.shape[1] - 1):
            codes.append(sum(2 ** k for k, (dr, dc) in enumerate(order) if gray[r + dr, c + dc] >= gray[r, c]))
    return codes
# %% name="> for >=" origin="fresh" sentence="Equally bright counts as yes: >=, not >." must_say=[">=|at least|equal"] kind="value"
def lbp_codes(gray):
    p = gray[1:-1, 1:-1]
    code = 1 * (gray[:-2, :-2] > p) + 2 * (gray[:-2, 1:-1] > p) + 4 * (gray[:-2, 2:] > p)
    code = code + 8 * (gray[1:-1, 2:] > p) + 16 * (gray[2:, 2:] > p) + 32 * (gray[2:, 1:-1] > p)
    code = code + 64 * (gray[2:, :-2] > p) + 128 * (gray[1:-1, :-2] > p)
    return code.astype(np.uint8)
# %% name="comparison reversed" origin="fresh" sentence="You ask if the pixel is as bright as the neighbour; it must be the other way round." must_say=["neighbour|revers|other way|exchang"] kind="value"
def lbp_codes(gray):
    p = gray[1:-1, 1:-1]
    code = 1 * (p >= gray[:-2, :-2]) + 2 * (p >= gray[:-2, 1:-1]) + 4 * (p >= gray[:-2, 2:])
    code = code + 8 * (p >= gray[1:-1, 2:]) + 16 * (p >= gray[2:, 2:]) + 32 * (p >= gray[2:, 1:-1])
    code = code + 64 * (p >= gray[2:, :-2]) + 128 * (p >= gray[1:-1, :-2])
    return code.astype(np.uint8)
# %% name="uint8 subtracted" origin="fresh" sentence="The pixels are uint8: a negative difference becomes a large number, so it is always >= 0." must_say=["uint8|subtract|negative|wrap"] kind="value"
def lbp_codes(gray):
    p = gray[1:-1, 1:-1]
    code = 1 * (gray[:-2, :-2] - p >= 0) + 2 * (gray[:-2, 1:-1] - p >= 0) + 4 * (gray[:-2, 2:] - p >= 0)
    code = code + 8 * (gray[1:-1, 2:] - p >= 0) + 16 * (gray[2:, 2:] - p >= 0)
    code = code + 32 * (gray[2:, 1:-1] - p >= 0) + 64 * (gray[2:, :-2] - p >= 0) + 128 * (gray[1:-1, :-2] - p >= 0)
    return code.astype(np.uint8)
# %% name="row by row" origin="fresh" sentence="The numbers go clockwise around the pixel, not row by row." must_say=["clockwise|order|row by row|around"] kind="value"
def lbp_codes(gray):
    height, width = gray.shape
    result = np.zeros((height - 2, width - 2), np.uint8)
    for row in range(1, height - 1):
        for col in range(1, width - 1):
            number, code = 1, 0
            for i in range(-1, 2):
                for j in range(-1, 2):
                    if i == 0 and j == 0:
                        continue
                    if gray[row + i, col + j] >= gray[row, col]:
                        code += number
                    number *= 2
            result[row - 1, col - 1] = code
    return result
# %% name="counterclockwise" origin="fresh" sentence="The numbers go counter-clockwise: the second one belongs to the upper middle." must_say=["clockwise|order|around|direction"] kind="value"
def lbp_codes(gray):
    p = gray[1:-1, 1:-1]
    code = 1 * (gray[:-2, :-2] >= p) + 2 * (gray[1:-1, :-2] >= p) + 4 * (gray[2:, :-2] >= p)
    code = code + 8 * (gray[2:, 1:-1] >= p) + 16 * (gray[2:, 2:] >= p) + 32 * (gray[1:-1, 2:] >= p)
    code = code + 64 * (gray[:-2, 2:] >= p) + 128 * (gray[:-2, 1:-1] >= p)
    return code.astype(np.uint8)
# %% name="only the middle" origin="fresh" sentence="Only the pixel [1, 1] gets a code; each pixel with eight neighbours needs one." must_say=["each|every|all|shape|one number"] kind="shape"
def lbp_codes(gray):
    answers = gray[0:3, 0:3] >= gray[1, 1]
    code = 1 * answers[0, 0] + 2 * answers[0, 1] + 4 * answers[0, 2] + 8 * answers[1, 2]
    code += 16 * answers[2, 2] + 32 * answers[2, 1] + 64 * answers[2, 0] + 128 * answers[1, 0]
    return np.array([[code]], np.uint8)
# %% name="128 at the upper left" origin="fresh" sentence="The numbers begin with 1 at the upper left and double clockwise; you begin with 128." must_say=["1, 2, 4|upper left|order|128"] kind="value"
def lbp_codes(gray):
    p = gray[1:-1, 1:-1]
    code = 128 * (gray[:-2, :-2] >= p) + 64 * (gray[:-2, 1:-1] >= p) + 32 * (gray[:-2, 2:] >= p)
    code = code + 16 * (gray[1:-1, 2:] >= p) + 8 * (gray[2:, 2:] >= p) + 4 * (gray[2:, 1:-1] >= p)
    code = code + 2 * (gray[2:, :-2] >= p) + 1 * (gray[1:-1, :-2] >= p)
    return code.astype(np.uint8)
# %% name="upper left neighbour as the pixel" origin="fresh" sentence="The pixel of result row i is in row i + 1 of the image; you take the upper left corner, and [-1] is the last row." must_say=["\\+ ?1|-1|negative|last row|one (row|pixel)|shift|moved"] kind="value"
def lbp_codes(gray):
    height, width = gray.shape
    result = np.zeros((height - 2, width - 2), np.uint8)
    around = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for row in range(height - 2):
        for col in range(width - 2):
            code = 0
            for k in range(8):
                i, j = around[k]
                if gray[row + i, col + j] >= gray[row, col]:
                    code += 2 ** k
            result[row, col] = code
    return result
# %% name="size of the image" origin="fresh" sentence="The result must be two rows and two columns smaller than the image." must_say=["shape|H ?[−-] ?2|smaller|border"] kind="shape"
def lbp_codes(gray):
    height, width = gray.shape
    result = np.zeros((height, width), np.uint8)
    around = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for row in range(1, height - 1):
        for col in range(1, width - 1):
            for k in range(8):
                i, j = around[k]
                if gray[row + i, col + j] >= gray[row, col]:
                    result[row, col] += 2 ** k
    return result
# %% name="counts the neighbours" origin="fresh" sentence="Each neighbour adds its own number 1, 2, 4 ...; you add 1 for each." must_say=["1, 2, 4|number of its own|own number|128|2 ?\\*\\*|counts?"] kind="value"
def lbp_codes(gray):
    height, width = gray.shape
    result = np.zeros((height - 2, width - 2), np.uint8)
    for row in range(1, height - 1):
        for col in range(1, width - 1):
            square = gray[row - 1:row + 2, col - 1:col + 2]
            result[row - 1, col - 1] = (square >= gray[row, col]).sum() - 1
    return result
