# %% name="argmax of the histogram" sentence="np.argmax(counts) is the most frequent gray level, not a threshold between two groups: compute the between-class variance of every t and take its argmax." must_say=["most (frequent|common)|largest count|highest peak|histogram", "between|variance"] must_not_say=["smallest difference"] kind="value"
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    return int(np.argmax(counts))
