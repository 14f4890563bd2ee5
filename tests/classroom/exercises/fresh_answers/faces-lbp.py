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
