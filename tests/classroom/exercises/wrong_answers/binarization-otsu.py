# %% name="argmax of the histogram" sentence="np.argmax(counts) is the most frequent gray level, not a threshold between two groups: compute the between-class variance of every t and take its argmax." must_say=["most (frequent|common)|largest count|highest peak|histogram", "between|variance"] must_not_say=["smallest difference"] kind="value"
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    return int(np.argmax(counts))

# %% name="no square, empty classes left out" sentence="The between-class variance has the square of the difference of the means: write ** 2." must_say=["between-class variance"] must_not_say=["nan\\b", "empty"] kind="value"
def otsu(gray):
    pairs = [(gray[gray <= t], gray[gray > t]) for t in range(256)]
    return int(np.argmax([a.size * b.size * (a.mean() - b.mean()) if a.size * b.size else 0 for a, b in pairs]))
