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

# %% name="greater or equal for both" origin="fresh" sentence="The pixel must be greater than the first neighbour: > and not >=." must_say=["greater than|>="] kind="value"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + 1 + dr, col + 1 + dc]
            second = padded[row + 1 - dr, col + 1 - dc]
            if value >= first and value >= second:
                result[row, col] = value
    return result

# %% name="diagonals exchanged" origin="fresh" sentence="The neighbours of the sectors 1 and 3 are exchanged: look them up in the table." must_say=["sector|table|diagonal"] kind="value"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 1: (-1, 1), 2: (-1, 0), 3: (-1, -1)}
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + 1 + dr, col + 1 + dc]
            second = padded[row + 1 - dr, col + 1 - dc]
            second_ok = value >= second if sector[row, col] in (0, 2) else value > second
            if value > first and second_ok:
                result[row, col] = value
    return result

# %% name="padded one off" origin="fresh" sentence="In padded the pixel is at (row + 1, col + 1); you take its neighbours at (row, col)." must_say=["row \\+ 1|padded|neighbour|shift"] kind="value"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + dr, col + dc]
            second = padded[row - dr, col - dc]
            if value > first and value >= second:
                result[row, col] = value
    return result

# %% name="255 instead of the magnitude again" origin="fresh" sentence="Store the magnitude itself, not 255." must_say=["magnitude|255"] kind="value"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + 1 + dr, col + 1 + dc]
            second = padded[row + 1 - dr, col + 1 - dc]
            second_ok = value >= second if sector[row, col] in (0, 2) else value > second
            if value > first and second_ok:
                result[row, col] = 255
    return result

# %% name="no padding" origin="fresh" sentence="At the border a neighbour is outside: pad the magnitude with zeros." must_say=["pad|outside|border"] kind="error"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    result = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = magnitude[row + dr, col + dc]
            second = magnitude[row - dr, col - dc]
            if value > first and value >= second:
                result[row, col] = value
    return result

# %% name="return inside the loop" origin="fresh" sentence="return stands inside the outer loop: only the first row is computed." must_say=["return.*(loop|inside)"] kind="value"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + 1 + dr, col + 1 + dc]
            second = padded[row + 1 - dr, col + 1 - dc]
            second_ok = value >= second if sector[row, col] in (0, 2) else value > second
            if value > first and second_ok:
                result[row, col] = value
        return result

# %% name="or instead of and" origin="fresh" sentence="A pixel must be greater than both neighbours: and, not or." must_say=["both|and\\b"] kind="value"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + 1 + dr, col + 1 + dc]
            second = padded[row + 1 - dr, col + 1 - dc]
            if value > first or value >= second:
                result[row, col] = value
    return result

# %% name="sectors in degrees" origin="fresh" sentence="sector holds 0 to 3, and not degrees." must_say=["sector|KeyError|key"] kind="error"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 45: (-1, -1), 90: (-1, 0), 135: (-1, 1)}
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + 1 + dr, col + 1 + dc]
            second = padded[row + 1 - dr, col + 1 - dc]
            if value > first and value >= second:
                result[row, col] = value
    return result

# %% name="magnitude written over" origin="fresh" sentence="magnitude itself is changed while it is read: write into a new array." must_say=["new array|copy|changed"] kind="input-changed"
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

# %% name="all sectors alike" origin="fresh" sentence="In sectors 1 and 3 the pixel must be greater than both neighbours." must_say=["sectors 1 and 3|greater than both"] kind="value"
def suppress(magnitude, sector):
    steps = {0: (0, -1), 1: (-1, -1), 2: (-1, 0), 3: (-1, 1)}
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[1]):
            dr, dc = steps[int(sector[row, col])]
            value = magnitude[row, col]
            first = padded[row + 1 + dr, col + 1 + dc]
            second = padded[row + 1 - dr, col + 1 - dc]
            if value > first and value >= second:
                result[row, col] = value
    return result
