# %% name="and between arrays" sentence="and works on single values only; between two arrays write & and put each comparison in parentheses." must_say=["\\band\\b|single|ambiguous", "&|logical_and"] kind="error"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    m = magnitude
    out = np.zeros_like(m)
    keep = m > p[1:-1, :-2] and m >= p[1:-1, 2:]
    out[keep & (sector == 0)] = m[keep & (sector == 0)]
    return out

# %% name="greater or equal to both" sentence="With >= on both sides two equal neighbours both survive: the first neighbour must be really smaller, so write > there." must_say=[">=|equal", "both survive|first neighbour|first", "strict|smaller|greater|>(?!=)"] must_not_say=["vanish"] kind="value"
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

# %% name="mask instead of magnitudes" sentence="You return a mask of True and False; the task wants int32: the magnitude where a pixel survives, and 0 elsewhere." must_say=["mask|bool|True", "magnitude|int32"] kind="dtype"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    h, w = magnitude.shape

    def at(dy, dx):
        return p[1 + dy : 1 + dy + h, 1 + dx : 1 + dx + w]

    m = magnitude
    keep = [(m > at(0, -1)) & (m >= at(0, 1)), (m > at(-1, -1)) & (m > at(1, 1)),
            (m > at(-1, 0)) & (m >= at(1, 0)), (m > at(-1, 1)) & (m > at(1, -1))]
    return np.choose(sector, keep)

# %% name="no return" sentence="The result is filled and never given back: add return out at the end." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
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

# %% name="magnitude written over" sentence="magnitude itself is changed while it is read: write into a new array." must_say=["new array|copy|changed"] kind="input-changed"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    padded = np.pad(magnitude, 1)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + 1 + dr, col + 1 + dc]
            second = padded[row + 1 - dr, col + 1 - dc]
            if not (value > first and value >= second):
                magnitude[row, col] = 0
    return magnitude
