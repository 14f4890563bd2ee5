# %% [markdown]
# # binarization-otsu

# %%
def scores(gray, score):
    """{t: score(below, above)} for every t that leaves no class empty."""
    pairs = {t: (gray[gray <= t].astype(float), gray[gray > t].astype(float)) for t in range(256)}
    return {t: score(below, above) for t, (below, above) in pairs.items() if below.size and above.size}

def best_of(gray, score):
    """The first t with the largest score."""
    score_at = scores(gray, score)
    return max(score_at, key=score_at.get, default=0)

def variance_of(below, above):
    count = below.size + above.size
    return below.size / count * above.size / count * (below.mean() - above.mean()) ** 2

def counts_of(gray):
    return np.bincount(gray.ravel(), minlength=256)

# %% role="mistake" name="the smallest variance instead of the largest" says="Your threshold has the smallest between-class variance, which is the same as the largest variance inside the classes. Look for the largest between-class variance instead."
def otsu(gray):
    return best_of(gray, lambda below, above: -variance_of(below, above))

# %% role="mistake" name="only the share of class 0" says="Only the share of class 0 is used. The formula multiplies by the shares of both classes: w0 * w1 * (mean0 - mean1) ** 2."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * (below.mean() - above.mean()) ** 2)

# %% role="mistake" name="only the share of class 1" says="Only the share of class 1 is used. The formula multiplies by the shares of both classes: w0 * w1 * (mean0 - mean1) ** 2."
def otsu(gray):
    return best_of(gray, lambda below, above: above.size * (below.mean() - above.mean()) ** 2)

# %% role="mistake" name="means in whole numbers" says="The means are whole numbers: // and int() drop the fraction. Divide with /, or use .mean(), and keep the float."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * above.size * (below.sum() // below.size - above.sum() // above.size) ** 2)

# %% role="mistake" name="medians instead of means" says="The medians of the classes are used. The formula needs their means: .mean()."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * above.size * (np.median(below) - np.median(above)) ** 2)

# %% role="mistake" name="sums in uint8" says="The sums of the gray levels were computed in uint8, which wraps around at 255. Use .mean(), or widen with astype(int) before you add."
def otsu(gray):
    def score(below, above):
        means = [part.sum() % 256 / part.size for part in (below, above)]
        return below.size * above.size * (means[0] - means[1]) ** 2

    return best_of(gray, score)

# %% role="mistake" name="means of the counts" says="The means are means of the counts, not of the gray levels. Each gray level must be multiplied by its count, and the sum divided by the number of pixels; or take the mean of the pixels of each class."
def otsu(gray):
    counts = counts_of(gray)
    best_t, largest = 0, -1.0
    for t in range(255):
        below, above = counts[: t + 1], counts[t + 1 :]
        variance = float(below.sum()) * float(above.sum()) * (below.mean() - above.mean()) ** 2
        if below.sum() and above.sum() and variance > largest:
            best_t, largest = t, variance
    return best_t

# %% role="mistake" name="means of the masks" says="The mean of a mask is a share of the pixels, not a gray level. Select the pixels with the mask first: gray[mask].mean()."
def otsu(gray):
    def score(below, above):
        w0, w1 = below.size / gray.size, above.size / gray.size
        return w0 * w1 * (w0 - w1) ** 2

    return best_of(gray, score)

# %% role="mistake" name="means over all pixels" says="Your means are sums: divided by nothing, or both by the same number, such as that of all pixels. A mean is the sum of a class, divided by the number of pixels of this class: gray[mask].mean()."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * above.size * (below.sum() - above.sum()) ** 2)

# %% role="mistake" name="the best variance never updated" says="This is the last t that splits the image. The best variance must get its new value in the loop, together with best_t."
def otsu(gray):
    return max(scores(gray, variance_of), default=0)

# %% role="mistake" name="stops at the first empty class" says="Your result is 0 if the image has no pixel of the gray level 0: then t = 0 leaves class 0 empty. With break the loop ends there; continue goes on with the next t. Without a test for an empty class, its mean is nan, and max() keeps nan if it comes first: leave such a t out."
def otsu(gray):
    return solution(gray) if gray.min() == 0 else 0

# %% role="mistake" name="a list that does not begin with t = 0" says="Your threshold is too small by the darkest gray level. The list of variances does not begin with t = 0, so the position in it is not t. Append 0 for each t that leaves a class empty, or store t itself."
def otsu(gray):
    return max(0, solution(gray) - int(gray.min()))

# %% role="mistake" name="the middle between the means" says="This is the middle between the two means of the best split. The task asks for the t of this split, the last gray level of class 0."
def otsu(gray):
    t = solution(gray)
    below, above = gray[gray <= t], gray[gray > t]
    return int((below.mean() + above.mean()) / 2) if above.size else t

# %% role="mistake" name="means left out" says="Your threshold depends on the shares alone. The formula multiplies them by the squared difference of the means: w0 * w1 * (mean0 - mean1) ** 2."
def otsu(gray):
    return best_of(gray, lambda below, above: below.size * above.size)

# %% role="mistake" name="the first decrease" says="The loop ends when the variance gets smaller for the first time, but it may grow again later. Try every t up to 255."
def otsu(gray):
    score_at = scores(gray, variance_of)
    smaller = [t - 1 for t in score_at if score_at[t] < score_at.get(t - 1, 0)]
    return smaller[0] if smaller else 255

# %% role="mistake" name="the sums of the variances" says="You add the variances inside the two classes without their shares. Take the between-class variance with both shares, w0 * w1 * (mean0 - mean1) ** 2, and its largest value."
def otsu(gray):
    return best_of(gray, lambda below, above: -below.var() - above.var())

# %% role="mistake" name="shares from t" says="The shares are computed from t. w0 is the share of the pixels in class 0, so divide the number of its pixels by the number of all pixels: below.size / gray.size."
def otsu(gray):
    score_at = scores(gray, lambda below, above: (below.mean() - above.mean()) ** 2)
    score_at = {t: t / 255 * (1 - t / 255) * score for t, score in score_at.items()}
    return max((t for t in score_at if score_at[t] > 0), key=score_at.get, default=0)

# %% role="mistake" name="divided by 8" says="The shares are divided by 8, the number of pixels of the example. Divide by the number of pixels of your image: gray.size."
def otsu(gray):
    def score(below, above):
        return below.size / 8 * (1 - below.size / 8) * (below.mean() - above.mean()) ** 2

    score_at = scores(gray, score)
    return max((t for t in score_at if score_at[t] > 0), key=score_at.get, default=0)

# %% role="mistake" name="four thresholds only" says="You try only the four thresholds of the example. Try every t from 0 to 255: range(256)."
def otsu(gray):
    score_at = scores(gray, variance_of)
    best_t = max((t for t in (15, 25, 100, 195) if t in score_at), key=score_at.get)
    return best_t

# %% role="mistake" name="the most frequent gray level" says="This is the most frequent gray level, the highest bar of the histogram. It is not a threshold between two classes: compute the between-class variance of every t, and take the t with the largest."
def otsu(gray):
    return int(np.argmax(counts_of(gray)))

# %% role="mistake" name="the middle of the range" says="This is the middle between the darkest and the brightest pixel. It ignores how many pixels have each gray level. Compute the between-class variance of every t instead."
def otsu(gray):
    return (int(gray.min()) + int(gray.max())) // 2

# %% role="mistake" name="the mean gray level" says="This is the mean gray level, which is not Otsu's threshold. Try every t, and keep the one with the largest between-class variance."
def otsu(gray):
    return int(gray.mean())

# %% role="mistake" name="the median gray level" says="This is the median gray level, which is not Otsu's threshold. Try every t, and keep the one with the largest between-class variance."
def otsu(gray):
    return int(np.median(gray))

# %% role="mistake" name="always 0" says="Your function returned 0 for every image: best_t never got a new value, or lost it again. Usual causes: return stands inside the for loop and ends it with the first t; best_t = 0 stands inside it; no variance is larger than 0 (print w0, w1 and the variance for one t: the shares need /, not //, and ** 2 belongs to the difference of the two means)."
def otsu(gray):
    return 0

# %% role="mistake" name="the first t that splits" says="Your loop ends with the first t that splits the image, because return is still inside the loop. Move return to the left, below the whole loop, so that every t is tried."
def otsu(gray):
    return int(gray.min()) if gray.min() < gray.max() else None

# %% role="mistake" name="always 255" says="Your function returned 255 for every image, the last t of the loop. Return the t with the largest between-class variance: store it in the loop."
def otsu(gray):
    return 255

# %% role="mistake" name="one too large" says="Your threshold is one too large: a pixel equal to t belongs to class 0. Split with gray <= t and gray > t. In a histogram the slice counts[:t] ends before t: write counts[: t + 1]."
def otsu(gray):
    return solution(gray) + 1 if gray.min() < gray.max() else 0

# %% role="mistake" name="one too large, always" says="Your threshold is one too large: a pixel equal to t belongs to class 0, so t is the last gray level of class 0."
def otsu(gray):
    return solution(gray) + 1

# %% role="mistake" name="one too small" says="Your threshold is one too small: t is the last gray level of class 0. Split with gray <= t and gray > t."
def otsu(gray):
    return solution(gray) - 1

# %% role="mistake" name="the last of equal thresholds" says="Several thresholds have the same largest variance, and you return the last of them. With >= a later t replaces an earlier one: use >, so that the smallest t stays."
def otsu(gray):
    score_at = scores(gray, variance_of)
    largest = max(score_at.values(), default=0)
    return max((t for t in score_at if score_at[t] == largest), default=0)

# %% role="mistake" name="the last of equal thresholds, also with an empty class" says="Several thresholds have the same largest variance, and you return the last of them. With >= a later t replaces an earlier one: use >, so that the smallest t stays."
def otsu(gray):
    score_at = dict.fromkeys(range(256), 0.0) | scores(gray, variance_of)
    return max(t for t in score_at if score_at[t] == max(score_at.values()))

# %% role="mistake" name="the mean of an empty class" says="A class without pixels has the mean nan, and np.argmax takes nan for the largest value. Leave out every t that leaves a class empty, or give it the variance 0."
def otsu(gray):
    splits = (gray <= t for t in range(256))
    return int(np.argmax([variance_of(gray[below], gray[~below]) for below in splits]))

# %% role="mistake" name="thresholds left out at both ends" says="The first and the last thresholds are not tried. Try every t from 0 to 255: range(256)."
def otsu(gray):
    score_at = {t: score for t, score in scores(gray, variance_of).items() if 1 <= t < 254}
    return max(score_at, key=score_at.get, default=1)

# %% role="mistake" name="the threshold 0 left out" says="The threshold 0 is not tried. Try every t from 0 to 255: range(256) begins with 0."
def otsu(gray):
    return max(1, solution(gray)) if gray.min() < gray.max() else 0

# %% role="mistake" name="the variance" says="You return the largest variance itself. The task asks for the t that has it."
def otsu(gray):
    return max(scores(gray, variance_of).values(), default=0.0)

# %% role="mistake" name="the variance from the numbers of pixels" says="You return the largest variance itself. The task asks for the t that has it."
def otsu(gray):
    return max((score * gray.size**2 for score in scores(gray, variance_of).values()), default=0.0)
