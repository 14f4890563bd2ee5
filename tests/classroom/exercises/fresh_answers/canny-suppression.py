# %% name=">= for the diagonals too" origin="fresh" sentence="In sectors 1 and 3 the pixel must be greater than both neighbours; you use >= for the second one." must_say=["1 and 3|diagonal|both|sectors? (1|3)|greater"] must_not_say=["sector 0 and 2 are|swap"] kind="value"
def suppress(magnitude, sector):
    height, width = magnitude.shape
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    steps = [(0, 1), (1, 1), (1, 0), (1, -1)]
    for row in range(height):
        for col in range(width):
            down, right = steps[sector[row, col]]
            value = magnitude[row, col]
            first = padded[row + 1 - down, col + 1 - right]
            second = padded[row + 1 + down, col + 1 + right]
            if value > first and value >= second:
                result[row, col] = value
    return result

# %% name="sectors 0 and 2 exchanged" origin="fresh" sentence="Sector 0 compares left and right, sector 2 above and below; you exchanged them." must_say=["0 and 2|exchang|swap|left and right|above and below|sector (0|2)"] must_not_say=["diagonal"] kind="value"
def suppress(magnitude, sector):
    height, width = magnitude.shape
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(height):
        for col in range(width):
            value = padded[row + 1, col + 1]
            if sector[row, col] == 0:
                first, second = padded[row, col + 1], padded[row + 2, col + 1]
            elif sector[row, col] == 1:
                first, second = padded[row, col], padded[row + 2, col + 2]
            elif sector[row, col] == 2:
                first, second = padded[row + 1, col], padded[row + 1, col + 2]
            else:
                first, second = padded[row, col + 2], padded[row + 2, col]
            if sector[row, col] == 0 or sector[row, col] == 2:
                keep = value > first and value >= second
            else:
                keep = value > first and value > second
            if keep:
                result[row, col] = value
    return result

# %% name="compares the whole sector array" origin="fresh" sentence="if sector == 0 asks the whole array: ask for the sector of this pixel, sector[row, col]." must_say=["sector\\[row, ?col\\]|each pixel|this pixel|whole array|one truth|truth value"] kind="error"
def suppress(magnitude, sector):
    height, width = magnitude.shape
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(height):
        for col in range(width):
            value = padded[row + 1, col + 1]
            if sector == 0:
                first, second = padded[row + 1, col], padded[row + 1, col + 2]
            elif sector == 1:
                first, second = padded[row, col], padded[row + 2, col + 2]
            elif sector == 2:
                first, second = padded[row, col + 1], padded[row + 2, col + 1]
            else:
                first, second = padded[row, col + 2], padded[row + 2, col]
            if sector == 0 or sector == 2:
                keep = value > first and value >= second
            else:
                keep = value > first and value > second
            if keep:
                result[row, col] = value
    return result

# %% name="255 instead of the magnitude" origin="fresh" sentence="Keep the magnitude of the pixel, not 255." must_say=["magnitude|255"] must_not_say=["sector"] kind="value"
def suppress(magnitude, sector):
    height, width = magnitude.shape
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(height):
        for col in range(width):
            value = padded[row + 1, col + 1]
            if sector[row, col] == 0:
                first, second = padded[row + 1, col], padded[row + 1, col + 2]
            elif sector[row, col] == 1:
                first, second = padded[row, col], padded[row + 2, col + 2]
            elif sector[row, col] == 2:
                first, second = padded[row, col + 1], padded[row + 2, col + 1]
            else:
                first, second = padded[row, col + 2], padded[row + 2, col]
            if sector[row, col] == 0 or sector[row, col] == 2:
                keep = value > first and value >= second
            else:
                keep = value > first and value > second
            if keep:
                result[row, col] = 255
    return result

# %% name="sector 3 missing" origin="fresh" sentence="Sector 3 has no branch, so its pixels are always 0: compare above right and below left." must_say=["sectors? (1 and )?3|above right|below left"] must_not_say=["sectors? 0"] kind="value"
def suppress(magnitude, sector):
    height, width = magnitude.shape
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(height):
        for col in range(width):
            value = padded[row + 1, col + 1]
            if sector[row, col] == 0:
                if value > padded[row + 1, col] and value >= padded[row + 1, col + 2]:
                    result[row, col] = value
            if sector[row, col] == 1:
                if value > padded[row, col] and value > padded[row + 2, col + 2]:
                    result[row, col] = value
            if sector[row, col] == 2:
                if value > padded[row, col + 1] and value >= padded[row + 2, col + 1]:
                    result[row, col] = value
    return result
