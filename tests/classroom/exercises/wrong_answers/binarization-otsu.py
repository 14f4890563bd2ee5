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

# %% name="not squared" sentence="The difference of the means must be squared." must_say=["power|square"] must_not_say=["nan"] kind="value"
def otsu(gray):
    variances = [0.0] * 256
    for t in range(gray.min(), gray.max()):
        below, above = gray[gray <= t], gray[gray > t]
        variances[t] = below.size * above.size * (below.mean() - above.mean())
    return int(np.argmax(variances))
