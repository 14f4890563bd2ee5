# %% name="greater" origin="new" sentence="An equal neighbour counts too: >=." must_say=[">=|equal"] kind="value"
def lbp_codes(gray):
    c = gray[1:-1, 1:-1]
    codes = np.zeros(c.shape, np.uint8)
    codes += 1 * (gray[:-2, :-2] > c).astype(np.uint8)
    codes += 2 * (gray[:-2, 1:-1] > c).astype(np.uint8)
    codes += 4 * (gray[:-2, 2:] > c).astype(np.uint8)
    codes += 8 * (gray[1:-1, 2:] > c).astype(np.uint8)
    codes += 16 * (gray[2:, 2:] > c).astype(np.uint8)
    codes += 32 * (gray[2:, 1:-1] > c).astype(np.uint8)
    codes += 64 * (gray[2:, :-2] > c).astype(np.uint8)
    codes += 128 * (gray[1:-1, :-2] > c).astype(np.uint8)
    return codes

# %% name="pixel first" origin="new" sentence="It is neighbour >= pixel, not the other way round." must_say=["other way round|neighbour >= pixel"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for r in range(1, gray.shape[0] - 1):
        for c in range(1, gray.shape[1] - 1):
            for k, (dr, dc) in enumerate(order):
                if gray[r, c] >= gray[r + dr, c + dc]:
                    codes[r - 1, c - 1] += 2 ** k
    return codes

# %% name="differences in uint8" origin="new" sentence="A difference of uint8 is never negative: compare without subtracting." must_say=["uint8|subtract"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for k, (dr, dc) in enumerate(order):
        moved = gray[1 + dr:gray.shape[0] - 1 + dr, 1 + dc:gray.shape[1] - 1 + dc]
        codes += ((moved - gray[1:-1, 1:-1]) >= 0).astype(np.uint8) << k
    return codes

# %% name="row by row" origin="new" sentence="The numbers go clockwise, not row by row." must_say=["clockwise", "row by row"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    k = 0
    for dr in (-1, 0, 1):
        for dc in (-1, 0, 1):
            if dr == 0 and dc == 0:
                continue
            moved = gray[1 + dr:gray.shape[0] - 1 + dr, 1 + dc:gray.shape[1] - 1 + dc]
            codes += (moved >= gray[1:-1, 1:-1]).astype(np.uint8) << k
            k += 1
    return codes

# %% name="counter-clockwise" origin="new" sentence="Your neighbours go counter-clockwise: they go clockwise." must_say=["clockwise"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    order = [(-1, -1), (0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0)]
    for k, (dr, dc) in enumerate(order):
        moved = gray[1 + dr:gray.shape[0] - 1 + dr, 1 + dc:gray.shape[1] - 1 + dc]
        codes += (moved >= gray[1:-1, 1:-1]).astype(np.uint8) << k
    return codes

# %% name="as on many web pages" origin="new" sentence="You begin on the right; the number 1 belongs to the upper left neighbour." must_say=["upper left", "right"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    order = [(0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0), (1, 1)]
    for k, (dr, dc) in enumerate(order):
        moved = gray[1 + dr:gray.shape[0] - 1 + dr, 1 + dc:gray.shape[1] - 1 + dc]
        codes += (moved >= gray[1:-1, 1:-1]).astype(np.uint8) << k
    return codes

# %% name="binary text read from the left" origin="new" sentence="The upper left neighbour adds 1, not 128." must_say=["128", "1"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for r in range(1, gray.shape[0] - 1):
        for c in range(1, gray.shape[1] - 1):
            bits = "".join("1" if gray[r + dr, c + dc] >= gray[r, c] else "0" for dr, dc in order)
            codes[r - 1, c - 1] = int(bits, 2)
    return codes

# %% name="counted" origin="new" sentence="Each neighbour adds its own number." must_say=["own number|1, 2, 4"] kind="value"
def lbp_codes(gray):
    c = gray[1:-1, 1:-1]
    codes = np.zeros(c.shape, np.uint8)
    for dr in (-1, 0, 1):
        for dc in (-1, 0, 1):
            if (dr, dc) != (0, 0):
                codes += gray[1 + dr:gray.shape[0] - 1 + dr, 1 + dc:gray.shape[1] - 1 + dc] >= c
    return codes

# %% name="2 times k" origin="new" sentence="It is 2 to the power of k: 2**k." must_say=["power|\\*\\*"] kind="value"
def lbp_codes(gray):
    codes = np.zeros((gray.shape[0] - 2, gray.shape[1] - 2), np.uint8)
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for k, (dr, dc) in enumerate(order):
        moved = gray[1 + dr:gray.shape[0] - 1 + dr, 1 + dc:gray.shape[1] - 1 + dc]
        codes += (2 * k * (moved >= gray[1:-1, 1:-1])).astype(np.uint8)
    return codes

# %% name="padded" origin="new" sentence="Leave the outermost pixels out: they have no eight neighbours." must_say=["outermost|leave"] kind="shape"
def lbp_codes(gray):
    padded = np.pad(gray, 1)
    codes = np.zeros(gray.shape, np.uint8)
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for k, (dr, dc) in enumerate(order):
        moved = padded[1 + dr:1 + dr + gray.shape[0], 1 + dc:1 + dc + gray.shape[1]]
        codes += (moved >= gray).astype(np.uint8) << k
    return codes

# %% name="frame of zeros" origin="new" sentence="The outermost pixels have no code: the result has two rows and two columns less than the image." must_say=["outermost|H - 2|border"] kind="shape"
def lbp_codes(gray):
    codes = np.zeros(gray.shape, np.uint8)
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    for r in range(1, gray.shape[0] - 1):
        for c in range(1, gray.shape[1] - 1):
            for k, (dr, dc) in enumerate(order):
                if gray[r + dr, c + dc] >= gray[r, c]:
                    codes[r, c] += 2 ** k
    return codes

# %% name="seven neighbours" origin="new" sentence="The neighbour on the left is missing." must_say=["left|128", "missing"] kind="value"
def lbp_codes(gray):
    c = gray[1:-1, 1:-1]
    codes = 1 * (gray[:-2, :-2] >= c) + 2 * (gray[:-2, 1:-1] >= c) + 4 * (gray[:-2, 2:] >= c)
    codes = codes + 8 * (gray[1:-1, 2:] >= c) + 16 * (gray[2:, 2:] >= c)
    codes = codes + 32 * (gray[2:, 1:-1] >= c) + 64 * (gray[2:, :-2] >= c)
    return codes.astype(np.uint8)

# %% name="right and left exchanged" origin="new" sentence="Left and right are exchanged: 8 is the neighbour on the right, gray[1:-1, 2:]." must_say=["right", "left"] kind="value"
def lbp_codes(gray):
    c = gray[1:-1, 1:-1]
    codes = 1 * (gray[:-2, 2:] >= c) + 2 * (gray[:-2, 1:-1] >= c) + 4 * (gray[:-2, :-2] >= c)
    codes = codes + 8 * (gray[1:-1, :-2] >= c) + 16 * (gray[2:, :-2] >= c)
    codes = codes + 32 * (gray[2:, 1:-1] >= c) + 64 * (gray[2:, 2:] >= c) + 128 * (gray[1:-1, 2:] >= c)
    return codes.astype(np.uint8)

# %% name="only the middle pixel" origin="new" sentence="Return one code for each pixel with eight neighbours." must_say=["each pixel"] kind="type"
def lbp_codes(gray):
    order = [(-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1)]
    code = 0
    for k, (dr, dc) in enumerate(order):
        if gray[1 + dr, 1 + dc] >= gray[1, 1]:
            code += 2 ** k
    return code

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def lbp_codes(gray):
    c = gray[1:-1, 1:-1]
    codes = 1 * (gray[:-2, :-2] >= c) + 2 * (gray[:-2, 1:-1] >= c)

# %% name="rolled the wrong way" origin="walk" sentence="The neighbours are on the opposite side: roll by (-down, -right)." must_say=["opposite"] kind="value"
def lbp_codes(gray):
    codes = np.zeros(gray.shape, np.uint8)
    for number, (down, right) in enumerate(((-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1))):
        moved = np.roll(gray, (down, right), axis=(0, 1))
        codes += (moved >= gray).astype(np.uint8) * 2 ** number
    return codes[1:-1, 1:-1]
