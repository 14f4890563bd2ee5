# %% name="shares left out of the formula" origin="walk" sentence="You maximize only (mean0 - mean1) ** 2: the formula also multiplies by the shares w0 and w1 of the two groups." must_say=["share|w0|w_0|number of pixels|group sizes|weight", "multipl|formula|both|times|missing|forg|left out|only"] must_not_say=["smallest"] kind="value"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = (low.mean() - high.mean()) ** 2
        if variance > best:
            best, best_t = variance, t
    return best_t

# %% name="argmax of the histogram" origin="walk" sentence="np.argmax(counts) is the most frequent gray level, not a threshold between two groups: compute the between-class variance of every t and take its argmax." must_say=["most (frequent|common)|largest count|highest peak|histogram", "between|variance"] must_not_say=["smallest difference"] kind="value"
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    return int(np.argmax(counts))

# %% name="t in uint8 never passes 255" origin="walk" sentence="t is a uint8, so t + 1 after 255 does not become 256 and the loop never ends: use a Python int, for t in range(256)." must_say=["uint8", "range|never ends|endless|for ?ever|256"] kind="too-slow"
def otsu(gray):
    import warnings

    warnings.simplefilter("ignore")
    t, best, best_t = np.uint8(0), -1.0, 0
    while t <= 255:
        low, high = gray[gray <= t], gray[gray > t]
        if low.size and high.size:
            variance = low.size * high.size * (low.mean() - high.mean()) ** 2
            if variance > best:
                best, best_t = variance, int(t)
        t += np.uint8(1)
    return best_t

# %% name="helper of the lesson" origin="walk" sentence="between_class_variance is defined in another cell: copy its definition into this cell, or compute the variance here." must_say=["between_class_variance", "cell|copy|define"] kind="other-cell"
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    return int(np.argmax([between_class_variance(counts, t) for t in range(256)]))

# %% name="last of equal maxima" origin="new" sentence="With >= a later t with the same variance replaces the earlier one, and the task asks for the smallest t: use >." must_say=[">=|equal|same variance|ties?\\b", "smallest|first|earlier", "use >|>|strict|replac|later|last"] must_not_say=["endless"] kind="value"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = (low.size / gray.size) * (high.size / gray.size) * (low.mean() - high.mean()) ** 2
        if variance >= best:
            best, best_t = variance, t
    return best_t

# %% name="groups split with < and >=" origin="new" sentence="Pixels equal to t belong to the lower group, so split with gray <= t and gray > t; your threshold comes out one too large." must_say=["<=|at or below|equal to t|one too large|belong", "group|above|>"] must_not_say=["share"] kind="value"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray < t], gray[gray >= t]
        if low.size == 0 or high.size == 0:
            continue
        variance = low.size * high.size * (low.mean() - high.mean()) ** 2
        if variance > best:
            best, best_t = variance, t
    return best_t

# %% name="smallest variance" origin="new" sentence="You look for the smallest between-class variance; Otsu takes the largest, because then the groups differ most." must_say=["smallest between|smallest|minimum|\\bmin\\b|wrong direction", "largest|\\bmax|greatest", "between-class|look for|takes|keep|variance", "look for|wrong|not the smallest|Otsu takes|instead"] kind="value"
def otsu(gray):
    best, best_t = float("inf"), 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = low.size * high.size * (low.mean() - high.mean()) ** 2
        if variance < best:
            best, best_t = variance, t
    return best_t

# %% name="the variance is returned" origin="new" sentence="You return the largest variance itself; the task asks for the t that has it." must_say=["variance", "itself|return", "the t that|threshold|argmax|\\bt\\b"] kind="type"
def otsu(gray):
    best = 0.0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = low.size / gray.size * high.size / gray.size * (low.mean() - high.mean()) ** 2
        best = max(best, variance)
    return best

# %% name="difference not squared" origin="new" sentence="The difference of the means must be squared: without ** 2 it is negative for every t." must_say=["squar|\\*\\* ?2", "mean|differ|negative|without"] kind="value"
def otsu(gray):
    best, best_t = -1e30, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = low.size * high.size * (low.mean() - high.mean())
        if variance > best:
            best, best_t = variance, t
    return best_t

# %% name="hard-coded from the lesson" origin="new" sentence="128 is a fixed number: the threshold must be computed from the gray levels of each image." must_say=["128|fixed|hard|typed|constant", "comput|each image|every image|other image|gray level"] kind="value"
def otsu(gray):
    return 128

# %% name="means of the counts" origin="new" sentence="counts[: t + 1].mean() is the mean of the counts, not of the gray levels: weigh each level with its count." must_say=["of the counts|counts? .*mean|mean .*counts?", "level|weigh"] kind="value"
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    best, best_t = -1.0, 0
    for t in range(255):
        n0, n1 = counts[: t + 1].sum(), counts[t + 1 :].sum()
        if n0 == 0 or n1 == 0:
            continue
        variance = float(n0) * float(n1) * (counts[: t + 1].mean() - counts[t + 1 :].mean()) ** 2
        if variance > best:
            best, best_t = variance, t
    return best_t

# %% name="slice of the histogram one short" origin="new" sentence="counts[:t] ends before t, so the pixels with gray level t are in the wrong group: write counts[: t + 1]." must_say=["ends before|slice|one short|off by one|wrong group|t itself|without t", "\\bt\\b|group"] kind="value"
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    levels = np.arange(256)
    variances = np.zeros(256)
    for t in range(256):
        n0, n1 = counts[:t].sum(), counts[t:].sum()
        if n0 == 0 or n1 == 0:
            continue
        m0 = (levels[:t] * counts[:t]).sum() / n0
        m1 = (levels[t:] * counts[t:]).sum() / n1
        variances[t] = n0 * n1 * (m0 - m1) ** 2
    return int(np.argmax(variances))

# %% name="empty group not handled" origin="new" sentence="Where one group is empty its mean is nan, and np.argmax takes a nan for the largest: leave such thresholds out, or give them the variance 0." must_say=["empty|no pixels|\\bnan\\b", "leave|skip|variance|\\bnan\\b"] kind="value"
def otsu(gray):
    import warnings

    warnings.simplefilter("ignore")
    variances = []
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        variances.append(low.size / gray.size * high.size / gray.size * (np.mean(low) - np.mean(high)) ** 2)
    return int(np.argmax(variances))

# %% name="empty image of one gray level" origin="new" sentence="If the image has only one gray level, no t splits it and best_t is never set: give it a start value before the loop." must_say=["one (gray )?level|never set|never assigned|start value|undefined|unbound|not (been )?(set|assigned|defined)|without a value", "start|before|value|assign|set"] kind="error"
def otsu(gray):
    best = 0.0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = low.size * high.size * (low.mean() - high.mean()) ** 2
        if variance > best:
            best = variance
            best_t = t
    return best_t

# %% name="histogram by range with a last bin missing" origin="new" sentence="range(1, 254) leaves out the first and the last thresholds: try all of them, range(256)." must_say=["leaves? out|not tried|missing|skip|range\\(1", "256|first|last|every|all"] kind="value"
def otsu(gray):
    best, best_t = -1.0, 1
    for t in range(1, 254):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = low.size * high.size * (low.mean() - high.mean()) ** 2
        if variance > best:
            best, best_t = variance, t
    return best_t

# %% name="sum of levels in uint8" origin="new" sentence="np.arange(..., dtype=np.uint8) times the counts is fine, but sums collected in uint8 wrap around at 255: use Python ints or int64." must_say=["sum", "wrap|255|overflow|uint8", "\\bints?\\b|int64|widen|astype|larger"] kind="value"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        m0 = low.sum(dtype=np.uint8) / low.size
        m1 = high.sum(dtype=np.uint8) / high.size
        variance = low.size * high.size * (m0 - m1) ** 2
        if variance > best:
            best, best_t = variance, t
    return best_t

# %% name="binary image instead of the threshold" origin="new" sentence="You return the binary image, but the task asks for the threshold, one number: return best_t." must_say=["binary image|\\bimage\\b|\\barray\\b", "number|threshold", "return"] kind="type"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = low.size * high.size * (low.mean() - high.mean()) ** 2
        if variance > best:
            best, best_t = variance, t
    return np.where(gray > best_t, 255, 0).astype(np.uint8)

# %% name="cv2 finds the threshold" origin="new" sentence="cv2 is refused here, since the task is Otsu by hand: compute the variance of every t with NumPy." must_say=["cv2|opencv", "refus|by hand|yourself|not allowed|numpy|forbid"] kind="refused"
import cv2


def otsu(gray):
    return int(cv2.threshold(gray, 0, 255, cv2.THRESH_OTSU)[0])

# %% name="the course's function" origin="new" sentence="otsu_threshold is the course's own function; the task is to write it: compute the variance of every t yourself." must_say=["otsu_threshold|course", "yourself|refus|by hand|write|compute|import|forbid|cell"] kind="refused"
from imgproc_course.imaging import otsu_threshold


def otsu(gray):
    return otsu_threshold(gray)

# %% name="return inside the loop" origin="new" sentence="The return stands inside the for loop, so the function ends with the first t: move it to the left, below the loop." must_say=["return", "loop|indent|first t"] kind="value"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size and high.size:
            variance = low.size * high.size * (low.mean() - high.mean()) ** 2
            if variance > best:
                best, best_t = variance, t
        return best_t

# %% name="no return" origin="new" sentence="The best threshold is found and then lost: add return best_t at the end." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size and high.size:
            variance = low.size * high.size * (low.mean() - high.mean()) ** 2
            if variance > best:
                best, best_t = variance, t

# %% name="within-class variance maximized" origin="new" sentence="You maximize the variance inside the groups; that one must be smallest, or take the between-class variance and its largest value." must_say=["within|inside", "between|smallest|\\bmin"] kind="value"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = low.size * low.var() + high.size * high.var()
        if variance > best:
            best, best_t = variance, t
    return best_t

# %% name="absolute difference instead of its square" origin="new" sentence="abs() is not the square: the formula needs (mean0 - mean1) ** 2, which gives a large difference more weight." must_say=["squar|\\*\\* ?2", "\\babs|absolute|formula"] kind="value"
def otsu(gray):
    best, best_t = -1.0, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        variance = low.size * high.size * abs(low.mean() - high.mean())
        if variance > best:
            best, best_t = variance, t
    return best_t

# %% name="means in whole numbers" origin="new" sentence="// cuts the fraction of the means off, and then two thresholds look equal that are not: divide with /." must_say=["//|fraction|integer division|whole|cut", "/|mean|float"] kind="value"
def otsu(gray):
    best, best_t = -1, 0
    for t in range(256):
        low, high = gray[gray <= t], gray[gray > t]
        if low.size == 0 or high.size == 0:
            continue
        mean_low, mean_high = int(low.sum()) // low.size, int(high.sum()) // high.size
        variance = low.size * high.size * (mean_low - mean_high) ** 2
        if variance > best:
            best, best_t = variance, t
    return best_t

# %% name="between_class_variance of section 3" origin="walk" sentence="Leave out every t with an empty class: its mean is nan, and np.argmax takes nan for the largest." must_say=["empty|without pixels", "nan", "leave out|variance 0"] kind="value"
def otsu(gray):
    counts = np.bincount(gray.ravel(), minlength=256)
    variances = []
    for t in range(256):
        variances.append(between_class_variance(counts, t))
    return int(np.argmax(variances))

# %% name="np.argmax of a numpy int" origin="walk" sentence="The list begins with the darkest gray level, not with 0, so the position of the maximum is not t." must_say=["begin|position|darkest"] must_not_say=["\\bnp\\.int|dtype"] kind="value"
def otsu(gray):
    variances = []
    for t in range(gray.min(), gray.max()):
        below, above = gray[gray <= t], gray[gray > t]
        variances.append(below.size * above.size * (below.mean() - above.mean()) ** 2)
    return np.argmax(variances)

# %% name="if below and above" origin="walk" sentence="below and above are arrays, and an array is neither True nor False: ask for their size, if below.size and above.size." must_say=["size|values"] kind="error"
def otsu(gray):
    best_t, best_variance = 0, 0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below and above:
            variance = below.size * above.size * (below.mean() - above.mean()) ** 2
            if variance > best_variance:
                best_t, best_variance = t, variance
    return best_t

# %% name="max() keeps nan if it comes first" origin="walk" sentence="The mean of an empty class is nan, and max() keeps nan if it comes first: leave out every t with an empty class." must_say=["empty", "nan", "leave"] kind="value"
def otsu(gray):
    v = []
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        v.append(below.size * above.size * (below.mean() - above.mean()) ** 2)
    return v.index(max(v))

# %% name="shares from t" origin="walk" sentence="w0 is the share of the pixels in class 0, below.size / gray.size, not t / 255." must_say=["share", "number of (its|all) pixels|size"] must_not_say=["\\bbreak\\b"] kind="value"
def otsu(gray):
    best, best_t = 0, 0
    for t in range(256):
        w0 = t / 255
        w1 = 1 - w0
        below = gray[gray <= t]
        above = gray[gray > t]
        if len(below) == 0 or len(above) == 0:
            continue
        v = w0 * w1 * (below.mean() - above.mean()) ** 2
        if v > best:
            best = v
            best_t = t
    return best_t

# %% name="divided by 8 as in the example" origin="walk" sentence="8 is the number of pixels of the example: divide by gray.size." must_say=["example|\\b8\\b", "gray\\.size|number of pixels of your"] kind="value"
def otsu(gray):
    best_variance = 0
    best_t = 0
    for t in range(256):
        below, above = gray[gray <= t], gray[gray > t]
        if below.size == 0 or above.size == 0:
            continue
        w0, w1 = below.size / 8, 1 - below.size / 8
        variance = w0 * w1 * (below.mean() - above.mean()) ** 2
        if variance > best_variance:
            best_variance = variance
            best_t = t
    return best_t

# %% name="only the four thresholds of the example" origin="walk" sentence="Try every t from 0 to 255, not only the four of the example." must_say=["four|example", "every t|range\\(256\\)"] kind="value"
def otsu(gray):
    best = -1
    for t in [15, 25, 100, 195]:
        below, above = gray[gray <= t], gray[gray > t]
        if below.size == 0 or above.size == 0:
            continue
        w0, w1 = below.size / gray.size, above.size / gray.size
        v = w0 * w1 * (below.mean() - above.mean()) ** 2
        if v > best:
            best, best_t = v, t
    return best_t

# %% name="whole shares" origin="new" sentence="// makes every share 0, so every variance is 0: shares need /." must_say=["share|w0", "/, not //|/ "] kind="value"
def otsu(gray):
    histogram = np.bincount(gray.ravel(), minlength=256)
    best_t, best_variance = 0, 0
    for t in range(256):
        below, above = histogram[: t + 1].sum(), histogram[t + 1 :].sum()
        if below == 0 or above == 0:
            continue
        w0, w1 = below // gray.size, above // gray.size
        mean0 = (np.arange(t + 1) * histogram[: t + 1]).sum() / below
        mean1 = (np.arange(t + 1, 256) * histogram[t + 1 :]).sum() / above
        variance = w0 * w1 * (mean1 - mean0) ** 2
        if variance > best_variance:
            best_t, best_variance = t, variance
    return best_t

# %% name="the variance of other classes" origin="new" sentence="You return the largest variance. Return the t that has it." must_say=["variance", "return|this t|the t"] kind="value" must_not_say=["always|every image"]
def otsu(gray):
    counts = np.bincount(gray.ravel())
    best = 0
    for t in range(256):
        w0 = counts[:t].sum()
        w1 = counts[t:].sum()
        m0 = gray[gray < t].mean()
        m1 = gray[gray > t].mean()
        v = w0 * w1 * (m0 - m1) ** 2
        if v > best:
            best = v
    return best

# %% name="return at the end of the loop" origin="new" sentence="The return is still inside the loop, so the function ends with the first t that splits the image: move it below the loop." must_say=["return", "loop", "below|after|outside|left"] kind="value" must_not_say=["//", "shares need"]
def otsu(gray):
    best_t = 0
    best_variance = 0
    for t in range(256):
        below = gray[gray <= t]
        above = gray[gray > t]
        if below.size == 0 or above.size == 0:
            continue
        w0 = below.size / gray.size
        w1 = above.size / gray.size
        variance = w0 * w1 * (below.mean() - above.mean()) ** 2
        if variance > best_variance:
            best_variance = variance
            best_t = t
        return best_t
