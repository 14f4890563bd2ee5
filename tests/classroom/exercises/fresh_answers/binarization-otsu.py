# %% name="last of equal thresholds" origin="fresh" sentence="The largest variance is kept with >=, so the last of several equal thresholds wins: use >, the smallest is asked." must_say=["smallest|>=|first|last|equal|several"] must_not_say=["class 0 contains|count"] kind="value"
def otsu(gray):
    best = 0
    best_variance = 0.0
    for t in range(256):
        dark = gray[gray <= t]
        bright = gray[gray > t]
        if dark.size == 0 or bright.size == 0:
            continue
        variance = dark.size / gray.size * bright.size / gray.size * (dark.mean() - bright.mean()) ** 2
        if variance >= best_variance:
            best_variance = variance
            best = t
    return best

# %% name="pixel equal to t in class 1" origin="fresh" sentence="A pixel equal to t belongs to class 0: use <= t and > t." must_say=["<=|equal|class 0|belong|> ?t"] must_not_say=["smallest of"] kind="value"
def otsu(gray):
    best = 0
    best_variance = 0
    for t in range(256):
        class0 = gray[gray < t]
        class1 = gray[gray >= t]
        if len(class0) > 0 and len(class1) > 0:
            w0 = len(class0) / gray.size
            w1 = len(class1) / gray.size
            variance = w0 * w1 * (class0.mean() - class1.mean()) ** 2
            if variance > best_variance:
                best_variance = variance
                best = t
    return best

# %% name="no weights" origin="fresh" sentence="You forgot the weights w0 and w1 in the formula." must_say=["weight|w0|w_0|share"] must_not_say=["equal to t|empty"] kind="value"
def otsu(gray):
    best = 0
    best_variance = 0
    for t in range(256):
        class0 = gray[gray <= t]
        class1 = gray[gray > t]
        if class0.size > 0 and class1.size > 0:
            variance = (class0.mean() - class1.mean()) ** 2
            if variance > best_variance:
                best_variance = variance
                best = t
    return best

# %% name="returns the variance" origin="fresh" sentence="You return the largest variance; the task asks for its threshold t." must_say=["threshold|variance|t\\b"] must_not_say=["equal to t|empty"] kind="value"
def otsu(gray):
    largest = 0
    for t in range(256):
        class0 = gray[gray <= t]
        class1 = gray[gray > t]
        if class0.size == 0 or class1.size == 0:
            variance = 0
        else:
            w0 = class0.size / gray.size
            w1 = class1.size / gray.size
            variance = w0 * w1 * (class0.mean() - class1.mean()) ** 2
        if variance > largest:
            largest = variance
    return int(largest)

# %% name="empty class gives nan" origin="fresh" sentence="An empty class has no mean, so its variance is nan, and argmax finds the nan: set it to 0." must_say=["empty|nan|no mean|no pixels"] kind="value"
def otsu(gray):
    variances = []
    for t in range(256):
        class0 = gray[gray <= t]
        class1 = gray[gray > t]
        w0 = class0.size / gray.size
        w1 = class1.size / gray.size
        variances.append(w0 * w1 * (class0.mean() - class1.mean()) ** 2)
    return int(np.argmax(variances))

# %% name="less instead of less or equal" origin="fresh" sentence="A pixel equal to t belongs to class 0: write <=." must_say=["<=|equal to t"] kind="value"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(256):
        below, above = gray[gray < t], gray[gray >= t]
        if below.size == 0 or above.size == 0:
            continue
        w0, w1 = below.size / gray.size, above.size / gray.size
        variance = w0 * w1 * (below.mean() - above.mean()) ** 2
        if variance > best_variance:
            best_t, best_variance = t, variance
    return best_t

# %% name="greater or equal, the last" origin="fresh" sentence="Of several thresholds the smallest counts: write > and not >=." must_say=["smallest|first|>="] kind="value"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below.size == 0 or above.size == 0:
            continue
        w0, w1 = below.size / gray.size, above.size / gray.size
        variance = w0 * w1 * (below.mean() - above.mean()) ** 2
        if variance >= best_variance:
            best_t, best_variance = t, variance
    return best_t

# %% name="the variance is returned" origin="fresh" sentence="Return the threshold t, not its variance." must_say=["not its variance|variance|return this t"] kind="type"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below.size == 0 or above.size == 0:
            continue
        variance = below.size * above.size * (below.mean() - above.mean()) ** 2
        if variance > best_variance:
            best_t, best_variance = t, variance
    return best_variance

# %% name="return in the loop" origin="fresh" sentence="return stands inside the loop: only t = 0 is tried." must_say=["return.*(loop|inside)"] kind="value"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below.size > 0 and above.size > 0:
            variance = below.size * above.size * (below.mean() - above.mean()) ** 2
            if variance > best_variance:
                best_t, best_variance = t, variance
        return best_t

# %% name="range(255)" origin="fresh" sentence="range(255) ends at 254: t = 255 is never tried, and this changes nothing, but the loop begins at 1." must_say=["every t|range|from 0"] kind="value"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(1, 255):
        below, above = gray[gray <= t], gray[gray > t]
        if below.size == 0 or above.size == 0:
            continue
        variance = below.size * above.size * (below.mean() - above.mean()) ** 2
        if variance > best_variance:
            best_t, best_variance = t, variance
    return best_t

# %% name="not squared" origin="fresh" sentence="The difference of the means is squared." must_say=["square"] kind="value"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below.size == 0 or above.size == 0:
            continue
        variance = below.size * above.size * abs(below.mean() - above.mean())
        if variance > best_variance:
            best_t, best_variance = t, variance
    return best_t

# %% name="mean of the masks" origin="fresh" sentence="(gray <= t).mean() is the share of the class, not the mean of its pixels." must_say=["mean.*(mask|pixels)|gray\\[|select|share"] kind="value"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(256):
        below, above = gray <= t, gray > t
        if not below.any() or not above.any():
            continue
        w0, w1 = below.mean(), above.mean()
        variance = w0 * w1 * (below.mean() - above.mean()) ** 2
        if variance > best_variance:
            best_t, best_variance = t, variance
    return best_t

# %% name="empty class" origin="fresh" sentence="An empty class has no mean: nan spoils the comparison; leave it out." must_say=["empty"] kind="value"
def otsu(gray):
    variances = []
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        variances.append(below.size * above.size * (below.mean() - above.mean()) ** 2)
    return int(np.argmax(variances))

# %% name="best never updated" origin="fresh" sentence="best_variance is never updated, so every later t wins." must_say=["update|best|remember|store|largest"] kind="value"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below.size == 0 or above.size == 0:
            continue
        variance = below.size * above.size * (below.mean() - above.mean()) ** 2
        if variance > best_variance:
            best_t = t
    return best_t

# %% name="gray.lenght" origin="fresh" sentence="An array has .size, the number of its values." must_say=["size"] kind="error"
def otsu(gray):
    best_t, best_variance = 0, 0.0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below.length == 0 or above.length == 0:
            continue
        variance = below.length * above.length * (below.mean() - above.mean()) ** 2
        if variance > best_variance:
            best_t, best_variance = t, variance
    return best_t

# %% name="Puts pixels equal to t in class 1 " origin="fresh" sentence="Puts pixels equal to t in class 1 (< instead of <=), so the threshold is one too large." must_say=["one too large"] kind="value"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(256):
        class0 = gray[gray < t]
        class1 = gray[gray >= t]
        if class0.size == 0 or class1.size == 0:
            variance = 0
        else:
            w0 = class0.size / gray.size
            w1 = class1.size / gray.size
            variance = w0 * w1 * (class0.mean() - class1.mean()) ** 2
        if variance > best:
            best = variance
            best_t = t
    return best_t

# %% name=">= keeps the last of several best thresholds" origin="fresh" sentence=">= keeps the last of several best thresholds; the smallest is wanted." must_say=["last of"] kind="value"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(256):
        dark = gray[gray <= t]
        bright = gray[gray > t]
        if len(dark) == 0 or len(bright) == 0:
            variance = 0
        else:
            w0 = len(dark) / gray.size
            w1 = len(bright) / gray.size
            variance = w0 * w1 * (dark.mean() - bright.mean()) ** 2
        if variance >= best:
            best = variance
            best_t = t
    return best_t

# %% name="Returns the largest variance and not the threshold that" origin="fresh" sentence="Returns the largest variance and not the threshold that belongs to it." must_say=["largest variance"] kind="type"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(256):
        class0 = gray[gray <= t]
        class1 = gray[gray > t]
        if class0.size == 0 or class1.size == 0:
            continue
        w0 = class0.size / gray.size
        w1 = class1.size / gray.size
        variance = w0 * w1 * (class0.mean() - class1.mean()) ** 2
        if variance > best:
            best = variance
            best_t = t
    return best

# %% name="Returns 0 from the whole function as soon as one class is" origin="fresh" sentence="Returns 0 from the whole function as soon as one class is empty, instead of going on with the next t." must_say=["returned 0|returns 0"] kind="value"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(256):
        class0 = gray[gray <= t]
        class1 = gray[gray > t]
        if class0.size == 0 or class1.size == 0:
            return 0
        w0 = class0.size / gray.size
        w1 = class1.size / gray.size
        variance = w0 * w1 * (class0.mean() - class1.mean()) ** 2
        if variance > best:
            best = variance
            best_t = t
    return best_t

# %% name="The loop begins at 1" origin="fresh" sentence="The loop begins at 1, so the threshold 0 is never tried." must_say=["threshold 0"] kind="value"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(1, 256):
        class0 = gray[gray <= t]
        class1 = gray[gray > t]
        if class0.size > 0 and class1.size > 0:
            w0 = class0.size / gray.size
            w1 = class1.size / gray.size
            variance = w0 * w1 * (class0.mean() - class1.mean()) ** 2
            if variance > best:
                best = variance
                best_t = t
    return best_t

# %% name="Uses the sums of the classes where the means are needed" origin="fresh" sentence="Uses the sums of the classes where the means are needed." must_say=["sums"] kind="value"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(256):
        class0 = gray[gray <= t]
        class1 = gray[gray > t]
        if class0.size == 0 or class1.size == 0:
            variance = 0
        else:
            w0 = class0.size / gray.size
            w1 = class1.size / gray.size
            m0 = float(np.sum(class0))
            m1 = float(np.sum(class1))
            variance = w0 * w1 * (m0 - m1) ** 2
        if variance > best:
            best = variance
            best_t = t
    return best_t

# %% name="The weights of the two classes are forgotten" origin="fresh" sentence="The weights of the two classes are forgotten: only the squared difference of the means is compared." must_say=["shares|weights"] kind="value"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(256):
        class0 = gray[gray <= t]
        class1 = gray[gray > t]
        if class0.size == 0 or class1.size == 0:
            variance = 0
        else:
            variance = (class0.mean() - class1.mean()) ** 2
        if variance > best:
            best = variance
            best_t = t
    return best_t

# %% name="class0 and class1 are the masks themselves" origin="fresh" sentence="class0 and class1 are the masks themselves; the pixels gray[mask] were never selected, so the means are those of True and False." must_say=["mask"] kind="value"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(256):
        class0 = gray <= t
        class1 = gray > t
        w0 = class0.sum() / gray.size
        w1 = class1.sum() / gray.size
        if w0 == 0 or w1 == 0:
            variance = 0
        else:
            variance = w0 * w1 * (class0.mean() - class1.mean()) ** 2
        if variance > best:
            best = variance
            best_t = t
    return best_t

# %% name="Returns the black-and-white image instead of the threshold" origin="fresh" sentence="Returns the black-and-white image instead of the threshold." must_say=["array|image"] kind="type"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(256):
        class0 = gray[gray <= t]
        class1 = gray[gray > t]
        if class0.size == 0 or class1.size == 0:
            variance = 0
        else:
            w0 = class0.size / gray.size
            w1 = class1.size / gray.size
            variance = w0 * w1 * (class0.mean() - class1.mean()) ** 2
        if variance > best:
            best = variance
            best_t = t
    binary = np.where(gray > best_t, 255, 0).astype(np.uint8)
    return binary

# %% name="The largest variance is never stored " origin="fresh" sentence="The largest variance is never stored (best stays 0), so the last t with any variance wins." must_say=["best variance|largest variance"] kind="value"
def otsu(gray):
    best = 0
    best_t = 0
    for t in range(0, 256):
        mask = gray <= t
        class0 = gray[mask]
        class1 = gray[~mask]
        if class0.size == 0 or class1.size == 0:
            variance = 0
        else:
            w0 = class0.size / gray.size
            w1 = class1.size / gray.size
            variance = w0 * w1 * (class0.mean() - class1.mean()) ** 2
        if variance > best:
            best_t = t
    return best_t
