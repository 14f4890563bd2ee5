# %% name="greater or equal on both sides" origin="new" sentence="Two equal neighbours were both kept: a pixel must be greater than its left neighbour, so write > there." must_say=["equal|>=", "left|first", "greater|>(?!=)|both"] must_not_say=["neither"] kind="value"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for col in range(magnitude.size):
        value = magnitude[col]
        if value >= p[col] and value >= p[col + 2]:
            out[col] = value
    return out

# %% name="greater than both" origin="new" sentence="Of two equal neighbours neither was kept: the right neighbour may be equal, so write >= there." must_say=["equal|>=", "neither|gap|right|lost"] must_not_say=["both kept"] kind="value"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    keep = (magnitude > p[:-2]) & (magnitude > p[2:])
    return np.where(keep, magnitude, 0)

# %% name="the two comparisons exchanged" origin="new" sentence="The two comparisons are swapped: write > for the left neighbour and >= for the right one." must_say=["swap|exchang|other way|wrong way|second of|right one", "left|right"] kind="value"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    keep = (magnitude >= p[:-2]) & (magnitude > p[2:])
    return np.where(keep, magnitude, 0)

# %% name="or instead of and" origin="new" sentence="With or one smaller neighbour is enough: a peak needs both comparisons, so use and." must_say=["\\bor\\b|one neighbour|\\|", "both|\\band\\b|&"] kind="value"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for col in range(magnitude.size):
        value = magnitude[col]
        if value > p[col] or value >= p[col + 2]:
            out[col] = value
    return out

# %% name="first and last pixel left out" origin="new" sentence="The first and the last pixel are always 0: outside the row the magnitude is 0, so pad with np.pad(magnitude, 1) and compare them, too." must_say=["first|last|ends|border|outermost", "\\b0\\b|left out|pad|never"] kind="value"
def keep_peaks(magnitude):
    out = np.zeros_like(magnitude)
    for col in range(1, magnitude.size - 1):
        value = magnitude[col]
        if value > magnitude[col - 1] and value >= magnitude[col + 1]:
            out[col] = value
    return out

# %% name="index outside the row" origin="new" sentence="The last pixel has no right neighbour, so magnitude[col + 1] is outside: pad the row with zeros first." must_say=["outside|out of bounds|no right neighbour|beyond", "pad|zero|limit|check"] kind="error"
def keep_peaks(magnitude):
    out = np.zeros_like(magnitude)
    for col in range(magnitude.size):
        value = magnitude[col]
        if value > magnitude[col - 1] and value >= magnitude[col + 1]:
            out[col] = value
    return out

# %% name="np.roll" origin="new" sentence="np.roll puts the last pixel beside the first one: outside the row the magnitude is 0, so pad with zeros." must_say=["roll|last|other end|opposite", "pad|zero|\\b0\\b"] kind="value"
def keep_peaks(magnitude):
    keep = (magnitude > np.roll(magnitude, 1)) & (magnitude >= np.roll(magnitude, -1))
    return np.where(keep, magnitude, 0)

# %% name="padded with the outermost pixels" origin="new" sentence="mode='edge' repeats the outermost pixels, but outside the row the magnitude is 0: use np.pad(magnitude, 1)." must_say=["edge|repeat|replicat", "\\b0\\b|zero|np\\.pad\\(magnitude, 1\\)"] kind="value"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1, mode="edge")
    keep = (magnitude > p[:-2]) & (magnitude >= p[2:])
    return np.where(keep, magnitude, 0)

# %% name="positions instead of magnitudes" origin="new" sentence="You return the positions of the peaks: return a row of the same length, with the magnitudes in it." must_say=["position|index|indices|shape|length", "same (length|size|shape)|as long as|magnitude|whole row"] kind="shape"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    return np.flatnonzero((magnitude > p[:-2]) & (magnitude >= p[2:]))

# %% name="the peaks alone" origin="new" sentence="magnitude[keep] returns the kept magnitudes alone: the result must have the same length as the row, with 0 for the other pixels." must_say=["alone|only|shape|length|shorter", "same (length|size|shape)|as long as|\\b0\\b|whole row"] kind="shape"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    keep = (magnitude > p[:-2]) & (magnitude >= p[2:])
    return magnitude[keep]

# %% name="True and False" origin="new" sentence="You return True and False: return the magnitude where a pixel is kept, and 0 elsewhere." must_say=["True|bool|mask", "magnitude|int32"] kind="dtype"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    return (magnitude > p[:-2]) & (magnitude >= p[2:])

# %% name="255 for a peak" origin="new" sentence="A peak keeps its magnitude: you write 255 instead." must_say=["255", "magnitude|value"] kind="value"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    keep = (magnitude > p[:-2]) & (magnitude >= p[2:])
    return np.where(keep, 255, 0).astype(np.int32)

# %% name="input changed" origin="new" sentence="You write the zeros into magnitude itself, so the input is changed: write into a new array." must_say=["input|magnitude|in place", "new array|copy"] kind="input-changed"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    magnitude[(magnitude <= p[:-2]) | (magnitude < p[2:])] = 0
    return magnitude

# %% name="return forgotten" origin="new" sentence="The function has no return: add return out at the end." must_say=["return"] kind="no-return"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for col in range(magnitude.size):
        if magnitude[col] > p[col] and magnitude[col] >= p[col + 2]:
            out[col] = magnitude[col]

# %% name="and between arrays" origin="new" sentence="and needs single values: between two arrays of True and False write &, with each comparison in parentheses." must_say=["\\band\\b|ambiguous|single", "&|logical_and"] kind="error"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    keep = magnitude > p[:-2] and magnitude >= p[2:]
    return np.where(keep, magnitude, 0)

# %% name="padding shifts the row" origin="new" sentence="After np.pad(magnitude, 1) pixel col is at p[col + 1]: its left neighbour is p[col], its right neighbour p[col + 2]." must_say=["pad", "\\+ ?1|\\+ ?2|shift|one (pixel|column)"] kind="value"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    out = np.zeros_like(magnitude)
    for col in range(magnitude.size):
        if magnitude[col] > p[col - 1] and magnitude[col] >= p[col + 1]:
            out[col] = magnitude[col]
    return out

# %% name="changed while comparing" origin="new" sentence="You set pixels of the array to 0 while you still compare, so a pixel is compared with a neighbour that is 0 already: compare with the unchanged magnitude." must_say=["while|already|copy|unchanged|original", "compar|neighbour"] kind="value"
def keep_peaks(magnitude):
    out = magnitude.copy()
    p = np.pad(out, 1)
    for col in range(magnitude.size):
        if not (p[col + 1] > p[col] and p[col + 1] >= p[col + 2]):
            p[col + 1] = 0
    return p[1:-1].copy()

# %% name="loop over values" origin="walk" sentence="for col in magnitude gives the magnitudes, not the positions: write for col in range(magnitude.size)." must_say=["positions|range"] kind="error"
def keep_peaks(magnitude):
    peaks = np.zeros_like(magnitude)
    for col in magnitude:
        if magnitude[col] > magnitude[col - 1] and magnitude[col] >= magnitude[col + 1]:
            peaks[col] = magnitude[col]
    return peaks

# %% name="argmax alone" origin="walk" sentence="A row can have several peaks." must_say=["several|largest"] must_not_say=["dtype"] kind="value"
def keep_peaks(magnitude):
    result = np.zeros(len(magnitude))
    i = magnitude.argmax()
    result[i] = magnitude[i]
    return result

# %% name="a list of the peaks alone" origin="walk" sentence="Return a row as long as magnitude, with 0 where there is no peak." must_say=["only the peaks|as long as", "\\b0\\b"] kind="shape"
def keep_peaks(magnitude):
    padded = [0] + list(magnitude) + [0]
    result = []
    for i in range(1, len(padded) - 1):
        if padded[i] > padded[i-1] and padded[i] >= padded[i+1]:
            result.append(padded[i])
    return result

# %% name="a threshold of 200" origin="walk" sentence="A peak is greater than its neighbours, whatever its size." must_say=["neighbour"] must_not_say=["largest magnitude of the row"] kind="value"
def keep_peaks(magnitude):
    return np.where(magnitude > 200, magnitude, 0)

# %% name="the length 8 typed" origin="new" sentence="You typed the length of the example, 8. Another row has another length: magnitude.size." must_say=["8|length", "another|size|len"] kind="error" must_not_say=["pad the image"]
def keep_peaks(magnitude):
    zero_padded = np.pad(magnitude, 1)
    result = np.zeros(8, dtype=np.int32)
    for col in range(8):
        if magnitude[col] > zero_padded[col] and magnitude[col] >= zero_padded[col + 2]:
            result[col] = magnitude[col]
    return result

# %% name="the pixels 1 to 6 typed" origin="new" sentence="You typed 7: another row has another length, magnitude.size. And the ends are pixels, too." must_say=["7|length", "another|size|len", "ends"] kind="error"
def keep_peaks(magnitude):
    result = np.zeros_like(magnitude)
    for col in range(1, 7):
        if magnitude[col] > magnitude[col - 1] and magnitude[col] >= magnitude[col + 1]:
            result[col] = magnitude[col]
    return result
