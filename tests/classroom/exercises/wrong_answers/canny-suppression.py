# %% name="greater or equal to both" origin="walk" sentence="With >= on both sides two equal neighbours both survive: the first neighbour must be really smaller, so write > there." must_say=[">=|equal", "both survive|first neighbour|first", "strict|smaller|greater|>(?!=)"] must_not_say=["vanish"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    offsets = {0: (0, 1), 1: (1, 1), 2: (1, 0), 3: (1, -1)}
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            dy, dx = offsets[int(sector[y, x])]
            m = magnitude[y, x]
            if m >= p[y + 1 - dy, x + 1 - dx] and m >= p[y + 1 + dy, x + 1 + dx]:
                out[y, x] = m
    return out

# %% name="greater than both in all sectors" origin="new" sentence="In sectors 0 and 2 the second neighbour may be equal (>=); with > on both sides two equal neighbours both vanish." must_say=[">=|at least|may be equal|equal", "vanish|sectors? 0|0 and 2|second"] must_not_say=["diagonal"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    offsets = {0: (0, 1), 1: (1, 1), 2: (1, 0), 3: (1, -1)}
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            dy, dx = offsets[int(sector[y, x])]
            m = magnitude[y, x]
            if m > p[y + 1 - dy, x + 1 - dx] and m > p[y + 1 + dy, x + 1 + dx]:
                out[y, x] = m
    return out

# %% name=">= on the second neighbour in every sector" origin="new" sentence="On the diagonals, sectors 1 and 3, the pixel must be greater than both neighbours: >= holds for sectors 0 and 2 only." must_say=["diagonal|sectors? 1|1 and 3", "both|only|strict"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    offsets = {0: (0, 1), 1: (1, 1), 2: (1, 0), 3: (1, -1)}
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            dy, dx = offsets[int(sector[y, x])]
            m = magnitude[y, x]
            if m > p[y + 1 - dy, x + 1 - dx] and m >= p[y + 1 + dy, x + 1 + dx]:
                out[y, x] = m
    return out

# %% name="first and second neighbour exchanged" origin="new" sentence="You have the two neighbours the wrong way round: > belongs to the left (or upper) neighbour, >= to the right (or lower) one." must_say=["swap|exchang|wrong way|other way|revers|turned", "first|left|upper|second"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            m, s, j, i = magnitude[y, x], sector[y, x], y + 1, x + 1
            if s == 0:
                keep = m >= p[j, i - 1] and m > p[j, i + 1]
            elif s == 1:
                keep = m > p[j - 1, i - 1] and m > p[j + 1, i + 1]
            elif s == 2:
                keep = m >= p[j - 1, i] and m > p[j + 1, i]
            else:
                keep = m > p[j - 1, i + 1] and m > p[j + 1, i - 1]
            if keep:
                out[y, x] = m
    return out

# %% name="sectors 0 and 2 exchanged" origin="new" sentence="You have sectors 0 and 2 exchanged: in sector 0 the gradient points along the row, so compare with left and right; in sector 2 with above and below." must_say=["sectors? 0|sector 2|0 and 2|direction", "left|above|row|across", "exchang|swap|along|wrong|turned|across"] must_not_say=["diagonal"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            m, s, j, i = magnitude[y, x], sector[y, x], y + 1, x + 1
            if s == 2:
                keep = m > p[j, i - 1] and m >= p[j, i + 1]
            elif s == 1:
                keep = m > p[j - 1, i - 1] and m > p[j + 1, i + 1]
            elif s == 0:
                keep = m > p[j - 1, i] and m >= p[j + 1, i]
            else:
                keep = m > p[j - 1, i + 1] and m > p[j + 1, i - 1]
            if keep:
                out[y, x] = m
    return out

# %% name="diagonals exchanged" origin="new" sentence="The two diagonals are exchanged: sector 1 compares with above left and below right, sector 3 with above right and below left." must_say=["diagonal|sectors? 1|1 and 3", "above left|above right|upper left|exchang|swap", "exchang|swap|wrong|sector 1|turned"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            m, s, j, i = magnitude[y, x], sector[y, x], y + 1, x + 1
            if s == 0:
                keep = m > p[j, i - 1] and m >= p[j, i + 1]
            elif s == 3:
                keep = m > p[j - 1, i - 1] and m > p[j + 1, i + 1]
            elif s == 2:
                keep = m > p[j - 1, i] and m >= p[j + 1, i]
            else:
                keep = m > p[j - 1, i + 1] and m > p[j + 1, i - 1]
            if keep:
                out[y, x] = m
    return out

# %% name="border left at 0" origin="new" sentence="You leave the border pixels out, so they are always 0; beyond the border the magnitude counts as 0: np.pad(magnitude, 1) puts these zeros there, and every pixel can be compared." must_say=["border|outermost", "leave|left out|always 0|stay|every pixel|not visited|inner", "pad|zeros?|counts as 0|every pixel"] kind="value"
def suppress(magnitude, sector):
    out = np.zeros_like(magnitude)
    for y in range(1, magnitude.shape[0] - 1):
        for x in range(1, magnitude.shape[1] - 1):
            m, s = magnitude[y, x], sector[y, x]
            if s == 0:
                keep = m > magnitude[y, x - 1] and m >= magnitude[y, x + 1]
            elif s == 1:
                keep = m > magnitude[y - 1, x - 1] and m > magnitude[y + 1, x + 1]
            elif s == 2:
                keep = m > magnitude[y - 1, x] and m >= magnitude[y + 1, x]
            else:
                keep = m > magnitude[y - 1, x + 1] and m > magnitude[y + 1, x - 1]
            if keep:
                out[y, x] = m
    return out

# %% name="border repeated" origin="new" sentence="mode=\"edge\" repeats the border, but here the magnitude beyond the border counts as 0: pad with zeros." must_say=["edge|repeat|replicat", "\\b0\\b|zero"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1, mode="edge")
    h, w = magnitude.shape

    def at(dy, dx):
        return p[1 + dy : 1 + dy + h, 1 + dx : 1 + dx + w]

    m = magnitude
    keep = [(m > at(0, -1)) & (m >= at(0, 1)), (m > at(-1, -1)) & (m > at(1, 1)),
            (m > at(-1, 0)) & (m >= at(1, 0)), (m > at(-1, 1)) & (m > at(1, -1))]
    return np.where(np.choose(sector, keep), m, 0).astype(np.int32)

# %% name="index wraps to the other side" origin="new" sentence="At the border x - 1 becomes -1, which Python takes as the last column, and x + 1 is outside: pad the magnitude with zeros first." must_say=["-1|last column|outside|out of bounds|negative", "pad|zero|border|check"] kind="error"
def suppress(magnitude, sector):
    out = np.zeros_like(magnitude)
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            m, s = magnitude[y, x], sector[y, x]
            if s == 0:
                keep = m > magnitude[y, x - 1] and m >= magnitude[y, x + 1]
            elif s == 1:
                keep = m > magnitude[y - 1, x - 1] and m > magnitude[y + 1, x + 1]
            elif s == 2:
                keep = m > magnitude[y - 1, x] and m >= magnitude[y + 1, x]
            else:
                keep = m > magnitude[y - 1, x + 1] and m > magnitude[y + 1, x - 1]
            if keep:
                out[y, x] = m
    return out

# %% name="np.roll wraps around" origin="new" sentence="np.roll brings the pixels of the opposite side in at the border, where the magnitude counts as 0: pad with zeros and slice." must_say=["roll|opposite|other side", "\\b0\\b|zero|pad|border"] kind="value"
def suppress(magnitude, sector):
    m = magnitude

    def at(dy, dx):
        return np.roll(m, (-dy, -dx), axis=(0, 1))

    keep = [(m > at(0, -1)) & (m >= at(0, 1)), (m > at(-1, -1)) & (m > at(1, 1)),
            (m > at(-1, 0)) & (m >= at(1, 0)), (m > at(-1, 1)) & (m > at(1, -1))]
    return np.where(np.choose(sector, keep), m, 0).astype(np.int32)

# %% name="larger than all eight neighbours" origin="new" sentence="You compare with all eight neighbours; only the two along the gradient count, and sector says which." must_say=["eight|\\b8\\b|all (the )?neighbo", "two|sector|along"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    h, w = magnitude.shape
    near = [p[y : y + h, x : x + w] for y in range(3) for x in range(3) if (y, x) != (1, 1)]
    return np.where(magnitude > np.max(near, axis=0), magnitude, 0)

# %% name="sector ignored" origin="new" sentence="You compare with left and right at every pixel; which two neighbours count depends on sector." must_say=["left and right at every|every pixel|ignor|never use|not use|same two|depends", "sector|direction"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    keep = (magnitude > p[1:-1, :-2]) & (magnitude >= p[1:-1, 2:])
    return np.where(keep, magnitude, 0)

# %% name="survivors become 255" origin="new" sentence="A pixel that survives must keep its magnitude, and you write 255 (or True) instead." must_say=["255", "magnitude|value|keep"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    h, w = magnitude.shape

    def at(dy, dx):
        return p[1 + dy : 1 + dy + h, 1 + dx : 1 + dx + w]

    m = magnitude
    keep = [(m > at(0, -1)) & (m >= at(0, 1)), (m > at(-1, -1)) & (m > at(1, 1)),
            (m > at(-1, 0)) & (m >= at(1, 0)), (m > at(-1, 1)) & (m > at(1, -1))]
    return np.where(np.choose(sector, keep), 255, 0).astype(np.int32)

# %% name="mask instead of magnitudes" origin="new" sentence="You return a mask of True and False; the task wants int32: the magnitude where a pixel survives, and 0 elsewhere." must_say=["mask|bool|True", "magnitude|int32"] kind="dtype"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    h, w = magnitude.shape

    def at(dy, dx):
        return p[1 + dy : 1 + dy + h, 1 + dx : 1 + dx + w]

    m = magnitude
    keep = [(m > at(0, -1)) & (m >= at(0, 1)), (m > at(-1, -1)) & (m > at(1, 1)),
            (m > at(-1, 0)) & (m >= at(1, 0)), (m > at(-1, 1)) & (m > at(1, -1))]
    return np.choose(sector, keep)

# %% name="changed in place" origin="new" sentence="You set pixels of magnitude to 0 while you still compare, so later pixels see changed neighbours, and the input is changed: write into a new array." must_say=["in place|while you|input|already|same array", "new array|copy|another array|separate"] kind="input-changed"
def suppress(magnitude, sector):
    h, w = magnitude.shape
    offsets = {0: (0, 1), 1: (1, 1), 2: (1, 0), 3: (1, -1)}

    def at(y, x):
        return magnitude[y, x] if 0 <= y < h and 0 <= x < w else 0

    for y in range(h):
        for x in range(w):
            dy, dx = offsets[int(sector[y, x])]
            m, first, second = at(y, x), at(y - dy, x - dx), at(y + dy, x + dx)
            keep = m > first and (m >= second if sector[y, x] in (0, 2) else m > second)
            if not keep:
                magnitude[y, x] = 0
    return magnitude

# %% name="uint8 result" origin="new" sentence="The result is uint8, but magnitudes run up to 1530: keep the dtype int32." must_say=["uint8", "int32"] kind="dtype"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros(magnitude.shape, np.uint8)
    offsets = {0: (0, 1), 1: (1, 1), 2: (1, 0), 3: (1, -1)}
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            s = int(sector[y, x])
            dy, dx = offsets[s]
            m, first, second = magnitude[y, x], p[y + 1 - dy, x + 1 - dx], p[y + 1 + dy, x + 1 + dx]
            if m > first and (m > second or (s in (0, 2) and m == second)):
                out[y, x] = min(int(m), 255)
    return out

# %% name="offset of the padding forgotten" origin="new" sentence="The padded array is shifted by one row and one column: pixel (y, x) stands at p[y + 1, x + 1] there." must_say=["pad", "shift|y ?\\+ ?1|one (row|pixel|column)|offset|moved"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            m, s = magnitude[y, x], sector[y, x]
            if s == 0:
                keep = m > p[y, x - 1] and m >= p[y, x + 1]
            elif s == 1:
                keep = m > p[y - 1, x - 1] and m > p[y + 1, x + 1]
            elif s == 2:
                keep = m > p[y - 1, x] and m >= p[y + 1, x]
            else:
                keep = m > p[y - 1, x + 1] and m > p[y + 1, x - 1]
            if keep:
                out[y, x] = m
    return out

# %% name="or instead of and" origin="new" sentence="With or one smaller neighbour is enough; a pixel survives only if both comparisons hold: use and." must_say=["\\bor\\b", "\\band\\b", "both|one|enough"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            m, s, j, i = magnitude[y, x], sector[y, x], y + 1, x + 1
            if s == 0:
                keep = m > p[j, i - 1] or m >= p[j, i + 1]
            elif s == 1:
                keep = m > p[j - 1, i - 1] or m > p[j + 1, i + 1]
            elif s == 2:
                keep = m > p[j - 1, i] or m >= p[j + 1, i]
            else:
                keep = m > p[j - 1, i + 1] or m > p[j + 1, i - 1]
            if keep:
                out[y, x] = m
    return out

# %% name="and between arrays" origin="walk" sentence="and works on single values only; between two arrays write & and put each comparison in parentheses." must_say=["\\band\\b|single|ambiguous", "&|logical_and"] kind="error"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    m = magnitude
    out = np.zeros_like(m)
    keep = m > p[1:-1, :-2] and m >= p[1:-1, 2:]
    out[keep & (sector == 0)] = m[keep & (sector == 0)]
    return out

# %% name="sector 3 forgotten" origin="new" sentence="Sector 3 has no branch, so its pixels are always dropped: add the comparison with above right and below left." must_say=["sector 3|fourth sector", "no branch|missing|forg|dropped|left out|add|above right"] must_not_say=["exchang"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            m, s, j, i = magnitude[y, x], sector[y, x], y + 1, x + 1
            keep = False
            if s == 0:
                keep = m > p[j, i - 1] and m >= p[j, i + 1]
            elif s == 1:
                keep = m > p[j - 1, i - 1] and m > p[j + 1, i + 1]
            elif s == 2:
                keep = m > p[j - 1, i] and m >= p[j + 1, i]
            if keep:
                out[y, x] = m
    return out

# %% name="nothing is suppressed" origin="new" sentence="You copy magnitude and never set a pixel to 0: a pixel that does not survive must become 0." must_say=["copy|copies|every pixel keeps|never set|nothing", "\\b0\\b|zero"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = magnitude.copy()
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            if sector[y, x] == 0 and magnitude[y, x] > p[y + 1, x] and magnitude[y, x] >= p[y + 1, x + 2]:
                out[y, x] = magnitude[y, x]
    return out

# %% name="rows and columns swapped in the loop" origin="new" sentence="An array is indexed rows first, and you write magnitude[x, y]: write magnitude[y, x], and the same for sector." must_say=["\\[y, ?x\\]|\\[x, ?y\\]|rows first", "first|swap|order|index|write"] kind="error"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            if sector[x, y] == 0 and magnitude[x, y] > p[x + 1, y] and magnitude[x, y] >= p[x + 1, y + 2]:
                out[x, y] = magnitude[x, y]
    return out

# %% name="no return" origin="new" sentence="The result is filled and never given back: add return out at the end." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    offsets = {0: (0, 1), 1: (1, 1), 2: (1, 0), 3: (1, -1)}
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            s = int(sector[y, x])
            dy, dx = offsets[s]
            m, first, second = magnitude[y, x], p[y + 1 - dy, x + 1 - dx], p[y + 1 + dy, x + 1 + dx]
            if m > first and (m > second or (s in (0, 2) and m == second)):
                out[y, x] = m

# %% name="magnitude narrowed to uint8" origin="new" sentence="You compare the magnitudes as uint8, and those above 255 wrap around: compare them as int32." must_say=["uint8|255|wrap", "int32|narrow|as they are|without|leave"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1).astype(np.uint8)
    out = np.zeros_like(magnitude)
    offsets = {0: (0, 1), 1: (1, 1), 2: (1, 0), 3: (1, -1)}
    for y in range(magnitude.shape[0]):
        for x in range(magnitude.shape[1]):
            s = int(sector[y, x])
            dy, dx = offsets[s]
            m, a, b = p[y + 1, x + 1], p[y + 1 - dy, x + 1 - dx], p[y + 1 + dy, x + 1 + dx]
            if m > a and (m > b or (s in (0, 2) and m == b)):
                out[y, x] = magnitude[y, x]
    return out

# %% name="number of rows used for the columns" origin="new" sentence="Both loops end at the number of rows, but an image need not be square: the columns end at magnitude.shape[1]." must_say=["shape\\[1\\]|width|columns", "row|square|height|shape\\[0\\]"] kind="value"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    offsets = {0: (0, 1), 1: (1, 1), 2: (1, 0), 3: (1, -1)}
    n = min(magnitude.shape)
    for y in range(n):
        for x in range(n):
            s = int(sector[y, x])
            dy, dx = offsets[s]
            m, a, b = magnitude[y, x], p[y + 1 - dy, x + 1 - dx], p[y + 1 + dy, x + 1 + dx]
            if m > a and (m > b or (s in (0, 2) and m == b)):
                out[y, x] = m
    return out

# %% name="padded magnitude and unpadded sector" origin="walk" sentence="The loops run over the padded shape, and sector is not padded: loop over the shape of magnitude, and add 1 to the indices of padded only." must_say=["padded", "loop|shape"] kind="error"
def suppress(magnitude, sector):
    padded = np.pad(magnitude, 1)
    thinned = np.zeros_like(magnitude)
    height, width = padded.shape
    for row in range(1, height):
        for col in range(1, width):
            value = padded[row, col]
            if sector[row, col] == 0:
                keep = value > padded[row, col - 1] and value >= padded[row, col + 1]
            elif sector[row, col] == 1:
                keep = value > padded[row - 1, col - 1] and value > padded[row + 1, col + 1]
            elif sector[row, col] == 2:
                keep = value > padded[row - 1, col] and value >= padded[row + 1, col]
            else:
                keep = value > padded[row - 1, col + 1] and value > padded[row + 1, col - 1]
            if keep:
                thinned[row, col] = value
    return thinned

# %% name="if for elif" origin="walk" sentence="The else belongs to the last if only, so it overwrites the neighbours of sectors 0 and 1: write elif." must_say=["elif"] must_not_say=["swap|exchanged"] kind="value"
def suppress(magnitude, sector):
    padded = np.pad(magnitude, 1)
    thinned = np.zeros_like(magnitude)
    height, width = magnitude.shape
    for row in range(height):
        for col in range(width):
            value = magnitude[row, col]
            if sector[row, col] == 0:
                first, second = padded[row + 1, col], padded[row + 1, col + 2]
            if sector[row, col] == 1:
                first, second = padded[row, col], padded[row + 2, col + 2]
            if sector[row, col] == 2:
                first, second = padded[row, col + 1], padded[row + 2, col + 1]
            else:
                first, second = padded[row, col + 2], padded[row + 2, col]
            if sector[row, col] in (0, 2):
                keep = value > first and value >= second
            else:
                keep = value > first and value > second
            if keep:
                thinned[row, col] = value
    return thinned

# %% name="keep not reset" origin="walk" sentence="keep stays True after the first pixel that is kept: set it to False at the beginning of each pixel." must_say=["\\bkeep\\b|False|reset"] must_not_say=["swap|exchanged"] kind="value"
def suppress(magnitude, sector):
    padded = np.pad(magnitude, 1)
    thinned = np.zeros_like(magnitude)
    keep = False
    height, width = magnitude.shape
    for row in range(height):
        for col in range(width):
            value = magnitude[row, col]
            s = sector[row, col]
            if s == 0 and value > padded[row + 1, col] and value >= padded[row + 1, col + 2]:
                keep = True
            if s == 1 and value > padded[row, col] and value > padded[row + 2, col + 2]:
                keep = True
            if s == 2 and value > padded[row, col + 1] and value >= padded[row + 2, col + 1]:
                keep = True
            if s == 3 and value > padded[row, col + 2] and value > padded[row + 2, col]:
                keep = True
            if keep:
                thinned[row, col] = value
    return thinned

# %% name="index of the loop variable sector" origin="walk" sentence="for sector in range(4) writes over the argument sector: give the variable of the loop another name, or leave this loop out." must_say=["argument sector|another name"] kind="error"
def suppress(magnitude, sector):
    padded = np.pad(magnitude, 1)
    thinned = np.zeros_like(magnitude)
    height, width = magnitude.shape
    for row in range(height):
        for col in range(width):
            for sector in range(4):
                value = magnitude[row, col]
                if sector[row, col] == 0:
                    keep = value > padded[row + 1, col] and value >= padded[row + 1, col + 2]
                    if keep:
                        thinned[row, col] = value
    return thinned

# %% name="the sector of a padded array" origin="walk" sentence="The sector is read one row and one column off." must_say=["sector", "padded|one row and one column|off"] must_not_say=["diagonals"] kind="value"
def suppress(magnitude, sector):
    h, w = magnitude.shape
    p = np.pad(magnitude, 1)
    s = np.pad(sector, 1)
    out = np.zeros_like(magnitude)
    for r in range(h):
        for c in range(w):
            v = p[r+1, c+1]
            if s[r, c] == 0: keep = v > p[r+1, c] and v >= p[r+1, c+2]
            elif s[r, c] == 1: keep = v > p[r, c] and v > p[r+2, c+2]
            elif s[r, c] == 2: keep = v > p[r, c+1] and v >= p[r+2, c+1]
            else: keep = v > p[r, c+2] and v > p[r+2, c]
            if keep: out[r, c] = v
    return out

# %% name="sectors numbered from 1" origin="walk" sentence="The sectors are numbered from 0 to 3." must_say=["sector", "0 to 3|from 0|numbered"] kind="value"
def suppress(magnitude, sector):
    h, w = magnitude.shape
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for r in range(h):
        for c in range(w):
            v = p[r+1, c+1]
            s = sector[r, c]
            keep = False
            if s == 1: keep = v > p[r+1, c] and v >= p[r+1, c+2]
            elif s == 2: keep = v > p[r, c] and v > p[r+2, c+2]
            elif s == 3: keep = v > p[r, c+1] and v >= p[r+2, c+1]
            elif s == 4: keep = v > p[r, c+2] and v > p[r+2, c]
            if keep: out[r, c] = v
    return out

# %% name="sector without row and col" origin="new" sentence="sector is the whole array; the sector of this pixel is sector[row, col]." must_say=["one value|whole array|\\[row, col\\]", "\\[row, col\\]"] kind="error"
def suppress(magnitude, sector):
    height, width = magnitude.shape
    padded = np.pad(magnitude, 1)
    thinned = np.zeros_like(magnitude)
    for row in range(height):
        for col in range(width):
            value = magnitude[row, col]
            s = sector
            if s == 0:
                a, b = padded[row + 1, col], padded[row + 1, col + 2]
            elif s == 1:
                a, b = padded[row, col], padded[row + 2, col + 2]
            elif s == 2:
                a, b = padded[row, col + 1], padded[row + 2, col + 1]
            else:
                a, b = padded[row, col + 2], padded[row + 2, col]
            if value > a and value >= b:
                thinned[row, col] = value
    return thinned

# %% name="the padded array read at row and col" origin="new" sentence="After the padding pixel (row, col) is at padded[row + 1, col + 1]." must_say=["padded\\[row \\+ 1, col \\+ 1\\]"] kind="value" must_not_say=["sector is read"]
def suppress(magnitude, sector):
    height, width = magnitude.shape
    padded = np.pad(magnitude, 1)
    thinned = np.zeros_like(magnitude)
    for row in range(height):
        for col in range(width):
            value = padded[row, col]
            s = sector[row, col]
            if s == 0:
                keep = value > padded[row, col - 1] and value >= padded[row, col + 1]
            elif s == 1:
                keep = value > padded[row - 1, col - 1] and value > padded[row + 1, col + 1]
            elif s == 2:
                keep = value > padded[row - 1, col] and value >= padded[row + 1, col]
            else:
                keep = value > padded[row - 1, col + 1] and value > padded[row + 1, col - 1]
            if keep:
                thinned[row, col] = value
    return thinned
