# %% name="a threshold of 200" sentence="A peak is greater than its neighbours, whatever its size." must_say=["neighbour"] must_not_say=["largest magnitude of the row"] kind="value"
def keep_peaks(magnitude):
    return np.where(magnitude > 200, magnitude, 0)

# %% name="loop over values" sentence="for col in magnitude gives the magnitudes, not the positions: write for col in range(magnitude.size)." must_say=["positions|range"] kind="error"
def keep_peaks(magnitude):
    peaks = np.zeros_like(magnitude)
    for col in magnitude:
        if magnitude[col] > magnitude[col - 1] and magnitude[col] >= magnitude[col + 1]:
            peaks[col] = magnitude[col]
    return peaks

# %% name="a list of the peaks alone" sentence="Return a row as long as magnitude, with 0 where there is no peak." must_say=["only the peaks|as long as", "\\b0\\b"] kind="shape"
def keep_peaks(magnitude):
    padded = [0] + list(magnitude) + [0]
    result = []
    for i in range(1, len(padded) - 1):
        if padded[i] > padded[i-1] and padded[i] >= padded[i+1]:
            result.append(padded[i])
    return result

# %% name="True and False" sentence="You return True and False: return the magnitude where a pixel is kept, and 0 elsewhere." must_say=["True|bool|mask", "magnitude|int32"] kind="dtype"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    return (magnitude > p[:-2]) & (magnitude >= p[2:])

# %% name="input changed" sentence="You write the zeros into magnitude itself, so the input is changed: write into a new array." must_say=["input|magnitude|in place", "new array|copy"] kind="input-changed"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    magnitude[(magnitude <= p[:-2]) | (magnitude < p[2:])] = 0
    return magnitude
