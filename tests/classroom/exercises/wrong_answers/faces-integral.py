# %% name="no padding" origin="new" sentence="The row and the column of zeros are missing." must_say=["zeros", "missing|pad"] kind="shape"
def integral_image(gray):
    return gray.astype(np.int64).cumsum(axis=0).cumsum(axis=1)

# %% name="padded behind" origin="new" sentence="The zeros belong above and on the left." must_say=["above", "left"] kind="value"
def integral_image(gray):
    sums = gray.astype(np.int64).cumsum(axis=0).cumsum(axis=1)
    return np.pad(sums, ((0, 1), (0, 1)))

# %% name="padded all round" origin="new" sentence="One row above and one column on the left are enough." must_say=["above|\\(\\(1, 0\\), \\(1, 0\\)\\)"] kind="shape"
def integral_image(gray):
    return np.pad(gray.astype(np.int64).cumsum(axis=0).cumsum(axis=1), 1)

# %% name="zeros above only" origin="new" sentence="The column of zeros on the left is missing." must_say=["left"] kind="shape"
def integral_image(gray):
    sums = gray.astype(np.int64).cumsum(axis=0).cumsum(axis=1)
    return np.pad(sums, ((1, 0), (0, 0)))

# %% name="columns only" origin="new" sentence="Add along the rows too: cumsum(axis=1)." must_say=["rows|axis=1"] kind="value"
def integral_image(gray):
    return np.pad(gray.astype(np.int64).cumsum(axis=0), ((1, 0), (1, 0)))

# %% name="rows only" origin="new" sentence="Add down the columns too: cumsum(axis=0)." must_say=["columns|axis=0"] kind="value"
def integral_image(gray):
    return np.pad(gray.astype(np.int64).cumsum(axis=1), ((1, 0), (1, 0)))

# %% name="no axis" origin="new" sentence="cumsum without an axis makes one row of the image: say axis=0, then axis=1." must_say=["axis"] kind="shape"
def integral_image(gray):
    return gray.astype(np.int64).cumsum()

# %% name="sums are not chained" origin="new" sentence="Use the second cumsum on the result of the first one." must_say=["second|result of the first|then"] kind="value"
def integral_image(gray):
    down = gray.astype(np.int64).cumsum(axis=0)
    right = gray.astype(np.int64).cumsum(axis=1)
    return np.pad(down + right, ((1, 0), (1, 0)))

# %% name="uint8 result" origin="new" sentence="The array is uint8, so the sums wrap round at 256: make it int64." must_say=["int64|uint8|256"] kind="value"
def integral_image(gray):
    sums = np.zeros((gray.shape[0] + 1, gray.shape[1] + 1), gray.dtype)
    for r in range(gray.shape[0]):
        for c in range(gray.shape[1]):
            sums[r + 1, c + 1] = gray[:r + 1, :c + 1].sum() % 256
    return sums

# %% name="loop counts twice" origin="new" sentence="What is above and on the left is counted twice: subtract it once." must_say=["twice", "subtract"] kind="value"
def integral_image(gray):
    h, w = gray.shape
    sums = np.zeros((h + 1, w + 1), np.int64)
    for r in range(1, h + 1):
        for c in range(1, w + 1):
            sums[r, c] = gray[r - 1, c - 1] + sums[r - 1, c] + sums[r, c - 1]
    return sums

# %% name="one row and column too early" origin="new" sentence="Each sum stops one row and one column too early." must_say=["early|gray\\[:r, :c\\]"] kind="value"
def integral_image(gray):
    h, w = gray.shape
    sums = np.zeros((h + 1, w + 1), np.int64)
    for r in range(1, h + 1):
        for c in range(1, w + 1):
            sums[r, c] = gray[:r - 1, :c - 1].sum()
    return sums

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def integral_image(gray):
    np.pad(gray.astype(np.int64).cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))

# %% name="total" origin="new" sentence="You return one sum. Return the whole table." must_say=["table|whole"] kind="type"
def integral_image(gray):
    return int(gray.astype(np.int64).sum())

# %% name="cv2" origin="new" sentence="Write it with NumPy: cv2 is not allowed here." must_say=["cv2"] kind="refused"
import cv2
def integral_image(gray):
    return cv2.integral(gray).astype(np.int64)
