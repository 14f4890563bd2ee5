# %% name="loop over values" sentence="for col in magnitude gives the magnitudes, not the positions: write for col in range(magnitude.size)." must_say=["positions|range"] kind="error"
def keep_peaks(magnitude):
    peaks = np.zeros_like(magnitude)
    for col in magnitude:
        if magnitude[col] > magnitude[col - 1] and magnitude[col] >= magnitude[col + 1]:
            peaks[col] = magnitude[col]
    return peaks

# %% name="input changed" sentence="You write the zeros into magnitude itself, so the input is changed: write into a new array." must_say=["input|magnitude|in place", "new array|copy"] kind="input-changed"
def keep_peaks(magnitude):
    p = np.pad(magnitude, 1)
    magnitude[(magnitude <= p[:-2]) | (magnitude < p[2:])] = 0
    return magnitude
