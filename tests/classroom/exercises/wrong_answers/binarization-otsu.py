# %% name="argmax of the histogram" sentence="np.argmax(counts) is the most frequent gray level, not a threshold between two groups: compute the between-class variance of every t and take its argmax." must_say=["most (frequent|common)|largest count|highest peak|histogram", "between|variance"] must_not_say=["smallest difference"] kind="value"
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    return int(np.argmax(counts))

# %% name="if below and above" sentence="below and above are arrays, and an array is neither True nor False: ask for their size, if below.size and above.size." must_say=["size|values"] kind="error"
def otsu(gray):
    best_t, best_variance = 0, 0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below and above:
            variance = below.size * above.size * (below.mean() - above.mean()) ** 2
            if variance > best_variance:
                best_t, best_variance = t, variance
    return best_t

# %% name="cv2 finds the threshold" sentence="cv2 is refused here, since the task is Otsu by hand: compute the variance of every t with NumPy." must_say=["cv2|opencv", "refus|by hand|yourself|not allowed|numpy|forbid"] kind="refused"
import cv2


def otsu(gray):
    return int(cv2.threshold(gray, 0, 255, cv2.THRESH_OTSU)[0])

# %% name="no return" sentence="The best threshold is found and then lost: add return best_t at the end." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size and high.size:
            variance = low.size * high.size * (low.mean() - high.mean()) ** 2
            if variance > best:
                best, best_t = variance, t
