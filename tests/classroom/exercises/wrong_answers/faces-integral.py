# %% name="columns only" sentence="Add along the rows too: cumsum(axis=1)." must_say=["rows|axis=1"] kind="value"
def integral_image(gray):
    return np.pad(gray.astype(np.int64).cumsum(axis=0), ((1, 0), (1, 0)))

# %% name="cv2" sentence="Write it with NumPy: cv2 is not allowed here." must_say=["cv2"] kind="refused"
import cv2
def integral_image(gray):
    return cv2.integral(gray).astype(np.int64)
