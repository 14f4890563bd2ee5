# %% name="no padding" sentence="The row and the column of zeros are missing." must_say=["zeros", "missing|pad"] kind="shape"
def integral_image(gray):
    return gray.astype(np.int64).cumsum(axis=0).cumsum(axis=1)

# %% name="columns only" sentence="Add along the rows too: cumsum(axis=1)." must_say=["rows|axis=1"] kind="value"
def integral_image(gray):
    return np.pad(gray.astype(np.int64).cumsum(axis=0), ((1, 0), (1, 0)))

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def integral_image(gray):
    np.pad(gray.astype(np.int64).cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))

# %% name="total" sentence="You return one sum. Return the whole table." must_say=["table|whole"] kind="type"
def integral_image(gray):
    return int(gray.astype(np.int64).sum())

# %% name="cv2" sentence="Write it with NumPy: cv2 is not allowed here." must_say=["cv2"] kind="refused"
import cv2
def integral_image(gray):
    return cv2.integral(gray).astype(np.int64)
