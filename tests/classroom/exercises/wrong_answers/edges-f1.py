# %% name="edges counted in steps of 255" origin="walk" sentence="edges holds 0 and 255, so edges.sum() counts each pixel 255 times: make a mask first, edges > 0." must_say=["255", "mask|> ?0|bool|count|=="] must_not_say=["tolerance is"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / edges.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="tolerance hard-coded as 2" origin="walk" sentence="You always use 2 pixels: use the argument tolerance, other calls give another number." must_say=["tolerance", "always|\\b2 pixels|fixed|hard|typed|argument", "\\b2\\b|fixed|hard|argument"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = 2

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="np.roll wraps around" origin="walk" sentence="np.roll brings pixels from the opposite side in at the border, so a pixel at the left counts as near one at the right: pad with False and slice." must_say=["roll|opposite|other side|wrap", "pad|border|slice"] kind="value"
def f1_score(edges, outlines, tolerance):
    def grow(mask):
        near = np.zeros_like(mask)
        for dy in range(-tolerance, tolerance + 1):
            for dx in range(-tolerance, tolerance + 1):
                near |= np.roll(mask, (dy, dx), axis=(0, 1))
        return near

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="percent" origin="walk" sentence="You return percent; F1 is a share between 0 and 1, so leave the factor 100 out." must_say=["percent|100|%", "share|between 0 and 1|0 to 1|leave|divide|without"] must_not_say=["255"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(100 * 2 * precision * recall / (precision + recall))

# %% name="no edges divides by zero" origin="walk" sentence="Without edges (or outlines) you divide by 0: return 0.0 in that case before you divide." must_say=["zero|\\b0\\b|\\bnan\\b|empty", "divi|return", "no edges|without edges|no outlines|empty|outlines"] must_not_say=["255"] kind="error"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    precision = int((found & grow(outlines)).sum()) / int(found.sum())
    recall = int((outlines & grow(found)).sum()) / int(outlines.sum())
    return 2 * precision * recall / (precision + recall)

# %% name="tolerance ignored" origin="new" sentence="You compare pixel with pixel and never use tolerance: a pixel counts also when one of the other's pixels is up to tolerance rows and columns away." must_say=["tolerance", "never|ignor|not use|pixel with pixel|exact|also when|same place"] must_not_say=["always 2"] kind="value"
def f1_score(edges, outlines, tolerance):
    found = edges > 0
    both = (found & outlines).sum()
    if both == 0:
        return 0.0
    precision = both / found.sum()
    recall = both / outlines.sum()
    return float(2 * precision * recall / (precision + recall))

# %% name="mean instead of the harmonic mean" origin="new" sentence="(precision + recall) / 2 is the plain mean; F1 is the harmonic mean, 2 * precision * recall / (precision + recall)." must_say=["harmonic|plain mean|average|/ ?2\\b|arithmetic", "precision|harmonic"] must_not_say=["tolerance"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    return float((precision + recall) / 2)

# %% name="factor 2 forgotten" origin="new" sentence="The factor 2 of the formula is missing: F1 is 2 * precision * recall / (precision + recall)." must_say=["factor|half|twice|missing|2 \\*", "\\b2\\b|twice|half", "factor|missing|forg|half"] must_not_say=["tolerance"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(precision * recall / (precision + recall))

# %% name="precision for both" origin="new" sentence="You divide both times by the number of edge pixels; recall is a share of the outline pixels: divide by outlines.sum()." must_say=["recall", "outline", "divid|share of the outline"] must_not_say=["tolerance"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / found.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="the grown edges counted" origin="new" sentence="You count the grown mask, which holds more pixels than there are edges: take the edge pixels themselves that lie on grown outlines, found & near." must_say=["grown|dilat|thick|more pixels", "themselves|original|found &|edge pixels|not grown|only"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    both = grow(found) & grow(outlines)
    precision = both.sum() / grow(found).sum()
    recall = both.sum() / grow(outlines).sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="the same hits for recall" origin="new" sentence="You use the edge pixels that lie on an outline for recall, too; recall needs the outline pixels that lie near an edge: grow the edges and count outlines & near." must_say=["recall", "outline pixels", "near|grow|too|also"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance
    h, w = outlines.shape
    p = np.pad(outlines, t)
    near = np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)
    found = edges > 0
    hits = (found & near).sum()
    if hits == 0:
        return 0.0
    precision = hits / found.sum()
    recall = min(1.0, hits / outlines.sum())
    return float(2 * precision * recall / (precision + recall))

# %% name="window one short" origin="new" sentence="range(2 * tolerance) ends one too early, so the pixels tolerance rows below (or columns to the right) are left out: the window has 2 * tolerance + 1 rows." must_say=["range|one (too|short|less)|ends", "\\+ ?1|below|right"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        near = mask.copy()
        for y in range(2 * t):
            for x in range(2 * t):
                near |= p[y : y + h, x : x + w]
        return near

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="rows and columns only, a cross" origin="new" sentence="You look along the row and along the column only; a pixel may be away in both at once, so look at the whole square." must_say=["along the row|cross|row and .*column only|only .*row", "both|square|diagonal|corner|whole"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        near = mask.copy()
        for k in range(2 * t + 1):
            near |= p[k : k + h, t : t + w]
            near |= p[t : t + h, k : k + w]
        return near

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="round distance" origin="new" sentence="You measure a round distance (or the sum of rows and columns); the task allows tolerance rows and tolerance columns, a square." must_say=["round|circle|distance|euclid", "square|rows and|columns"] kind="value"
def f1_score(edges, outlines, tolerance):
    def near(points, others):
        hits = 0
        for y, x in points:
            distance = np.sqrt(((others - (y, x)) ** 2).sum(axis=1))
            hits += bool((distance <= tolerance).any())
        return hits

    found, true = np.argwhere(edges > 0), np.argwhere(outlines)
    if len(found) == 0 or len(true) == 0:
        return 0.0
    precision, recall = near(found, true) / len(found), near(true, found) / len(true)
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="less than the tolerance" origin="new" sentence="You take pixels less than tolerance away; at most tolerance means <=." must_say=["<=|at most|less than", "tolerance", "<=|at most|equal"] kind="value"
def f1_score(edges, outlines, tolerance):
    def near(points, others):
        hits = 0
        for y, x in points:
            hits += bool((np.abs(others - (y, x)).max(axis=1) < tolerance).any())
        return hits

    found, true = np.argwhere(edges > 0), np.argwhere(outlines)
    if len(found) == 0 or len(true) == 0:
        return 0.0
    precision, recall = near(found, true) / len(found), near(true, found) / len(true)
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="rows or columns" origin="new" sentence="You accept a pixel that is near in the rows or in the columns; it must be near in both: use and." must_say=["\\bor\\b in the columns|rows or|\\bor\\b", "must|\\band\\b", "both", "\\band\\b"] kind="value"
def f1_score(edges, outlines, tolerance):
    def near(points, others):
        hits = 0
        for y, x in points:
            rows, columns = np.abs(others[:, 0] - y), np.abs(others[:, 1] - x)
            hits += bool(((rows <= tolerance) | (columns <= tolerance)).any())
        return hits

    found, true = np.argwhere(edges > 0), np.argwhere(outlines)
    if len(found) == 0 or len(true) == 0:
        return 0.0
    precision, recall = near(found, true) / len(found), near(true, found) / len(true)
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="pairs counted instead of pixels" origin="new" sentence="You count every pair of an edge pixel and an outline pixel, so one pixel counts several times: stop after the first hit (break), or use any." must_say=["pair|several times|more than once|counts? twice", "break|\\bany\\b|once|first"] kind="value"
def f1_score(edges, outlines, tolerance):
    found, true = np.argwhere(edges > 0), np.argwhere(outlines)
    if len(found) == 0 or len(true) == 0:
        return 0.0
    hits = 0
    for y, x in found:
        for v, u in true:
            if abs(y - v) <= tolerance and abs(x - u) <= tolerance:
                hits += 1
    precision, recall = hits / len(found), hits / len(true)
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="IoU" origin="new" sentence="Intersection over union is another measure (IoU): F1 is computed from precision and recall." must_say=["union|IoU|jaccard|another measure", "precision|recall|F1"] kind="value"
def f1_score(edges, outlines, tolerance):
    found = edges > 0
    union = (found | outlines).sum()
    if union == 0:
        return 0.0
    return float((found & outlines).sum() / union)

# %% name="nothing on the other divides by zero" origin="new" sentence="When nothing lies on the other, precision and recall are both 0 and you divide by 0: return 0.0 first." must_say=["zero|\\b0\\b|\\bnan\\b", "nothing|both 0|precision and recall|precision \\+ recall|sum", "divi|return"] kind="error"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = int((found & grow(outlines)).sum()) / int(found.sum())
    recall = int((outlines & grow(found)).sum()) / int(outlines.sum())
    return 2 * precision * recall / (precision + recall)

# %% name="bitwise and of 255 and True" origin="new" sentence="edges holds 255 and the mask True, and 255 & True is 1: make a mask of edges first, edges > 0, and count with it." must_say=["255|uint8", "> ?0|compare|== ?255|mask"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    if not edges.any() or not outlines.any():
        return 0.0
    precision = (edges & grow(outlines)).sum() / edges.sum()
    recall = (outlines & grow(edges > 0)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="edges are 1, not 255" origin="new" sentence="You look for edges == 1, but an edge pixel is 255: write edges > 0 or edges == 255." must_say=["255", "== ?1|\\b1\\b|> ?0|== ?255"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges == 1
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="three numbers returned" origin="new" sentence="You return precision, recall and F1; the task asks for F1 alone, one float." must_say=["alone|only|one (float|number)|single", "three|tuple|precision, recall"] kind="type"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0, 0.0, 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0, 0.0, 0.0
    return precision, recall, float(2 * precision * recall / (precision + recall))

# %% name="rounded as in the lesson" origin="new" sentence="You round to two digits as the lesson does when it prints: return the whole float." must_say=["\\bround to|\\bround\\b|rounded", "leave|full|exact|digits|whole"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return round(float(2 * precision * recall / (precision + recall)), 2)

# %% name="cv2.dilate" origin="walk" sentence="cv2 is refused in this task: look at the shifted slices of a padded mask instead of cv2.dilate." must_say=["cv2|opencv|dilate", "refus|not allowed|numpy|yourself|by hand|slice|forbid"] kind="refused"
import cv2


def f1_score(edges, outlines, tolerance):
    kernel = np.ones((2 * tolerance + 1, 2 * tolerance + 1), np.uint8)
    found = edges > 0
    near_outlines = cv2.dilate(outlines.astype(np.uint8), kernel) > 0
    near_edges = cv2.dilate(found.astype(np.uint8), kernel) > 0
    precision = (found & near_outlines).sum() / max(found.sum(), 1)
    recall = (outlines & near_edges).sum() / max(outlines.sum(), 1)
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="sklearn's f1_score" origin="new" sentence="sklearn's f1_score knows no tolerance and is refused here: compute precision and recall yourself." must_say=["sklearn|scikit|library", "refus|tolerance|yourself|not allowed|forbid"] kind="refused"
from sklearn import metrics


def f1_score(edges, outlines, tolerance):
    return float(metrics.f1_score(outlines.ravel(), edges.ravel() > 0))

# %% name="score of another cell" origin="new" sentence="share_near is defined in another cell (and works for 2 pixels only): compute the shares inside your own cell." must_say=["share_near|another cell|other cell", "cell|own|inside|copy|define"] kind="other-cell"
def f1_score(edges, outlines, tolerance):
    found = edges > 0
    precision, recall = share_near(found, outlines), share_near(outlines, found)
    return 2 * precision * recall / max(precision + recall, 1e-9)

# %% name="swapped precision and recall, sum of both" origin="new" sentence="You multiply nothing: F1 divides 2 * precision * recall by their sum, and you return the sum itself." must_say=["the sum|add", "multipl|divid|formula", "sum itself|itself|sum|product"] kind="value"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    return float(precision + recall)

# %% name="input changed" origin="new" sentence="edges[edges > 0] = 1 changes the caller's array: store the mask under a new name, found = edges > 0." must_say=["chang|input|caller|overwrit|in place", "new name|copy|mask|> ?0"] kind="input-changed"
def f1_score(edges, outlines, tolerance):
    edges[edges > 0] = 1
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges == 1
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="print instead of return" origin="new" sentence="You print F1 and return nothing: use return." must_say=["return", "print"] kind="no-return"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any() or not outlines.any():
        print(0.0)
    else:
        precision = (found & grow(outlines)).sum() / found.sum()
        recall = (outlines & grow(found)).sum() / outlines.sum()
        print(2 * precision * recall / max(precision + recall, 1e-9))

# %% name="no outlines divides by zero" origin="new" sentence="You return 0.0 where there are no edges, but without outlines recall still divides by 0: return 0.0 then, too." must_say=["outlines", "zero|\\b0\\b|\\bnan\\b|empty", "divi|return|without|no outlines"] kind="error"
def f1_score(edges, outlines, tolerance):
    t = tolerance

    def grow(mask):
        h, w = mask.shape
        p = np.pad(mask, t)
        return np.any([p[y : y + h, x : x + w] for y in range(2 * t + 1) for x in range(2 * t + 1)], axis=0)

    found = edges > 0
    if not found.any():
        return 0.0
    precision = int((found & grow(outlines)).sum()) / int(found.sum())
    recall = int((outlines & grow(found)).sum()) / int(outlines.sum())
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="tolerance 0 cuts everything away" origin="new" sentence="With tolerance 0 the slice [t:-t] becomes [0:0] and is empty: cut with t : t + height instead." must_say=["tolerance|\\[?t ?: ?-t|\\b0\\b", "empty|slice|\\b0:0|shape|height"] kind="error"
def f1_score(edges, outlines, tolerance):
    t = tolerance
    found = edges > 0

    def grow(mask):
        p = np.pad(mask, t)
        near = np.zeros_like(p)
        for y, x in np.argwhere(p):
            near[y - t : y + t + 1, x - t : x + t + 1] = True
        return near[t:-t, t:-t]

    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & grow(outlines)).sum() / found.sum()
    recall = (outlines & grow(found)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return float(2 * precision * recall / (precision + recall))

# %% name="edges without > 0 into near" origin="walk" sentence="edges holds 0 and 255, so sums count 255 for each edge pixel: make a mask first, edges > 0." must_say=["255", "mask|> 0"] must_not_say=["harmonic"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result | padded[row : row + height, col : col + width]
    return result


def f1_score(edges, outlines, tolerance):
    if edges.sum() == 0 or outlines.sum() == 0:
        return 0.0
    precision = (edges & near(outlines, tolerance)).sum() / edges.sum()
    recall = (outlines & near(edges, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="divisors exchanged" origin="walk" sentence="The two divisors are exchanged: precision is a share of the edge pixels, recall of the outline pixels." must_say=["exchanged|swapped", "precision", "recall"] kind="value"
def f1_score(edges, outlines, tolerance):
    def near(mask, t):
        h, w = mask.shape
        p = np.pad(mask, t)
        out = np.zeros_like(mask)
        for r in range(2 * t + 1):
            for c in range(2 * t + 1):
                out |= p[r:r+h, c:c+w]
        return out
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / outlines.sum()
    recall = (outlines & near(found, tolerance)).sum() / found.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="edges used as a mask" origin="new" sentence="edges is 0 or 255, so its sum counts 255 for each pixel: begin with found = edges > 0." must_say=["255", "edges > 0|mask"] kind="value"
def f1_score(edges, outlines, tolerance):
    def near(mask):
        height, width = mask.shape
        padded = np.pad(mask, tolerance)
        result = np.zeros_like(mask)
        for row in range(2 * tolerance + 1):
            for col in range(2 * tolerance + 1):
                result |= padded[row : row + height, col : col + width]
        return result

    precision = (edges & near(outlines)).sum() / edges.sum()
    recall = (outlines & near(edges)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="the mean of both, nan without edges" origin="new" sentence="This is the arithmetic mean; F1 is the harmonic mean. And without edges you divide by 0." must_say=["harmonic", "mean", "divide"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result |= padded[row : row + height, col : col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return (precision + recall) / 2

# %% name="both masks grown, nan without edges" origin="new" sentence="Count the edge pixels and the outline pixels themselves, not those of the grown masks. And without edges you divide by 0." must_say=["grown|themselves", "divide"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result |= padded[row : row + height, col : col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    precision = (near(found, tolerance) & near(outlines, tolerance)).sum() / near(found, tolerance).sum()
    recall = (near(outlines, tolerance) & near(found, tolerance)).sum() / near(outlines, tolerance).sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="missed outlines without the tolerance" origin="new" sentence="An outline pixel is missed only if no edge is near it: fn = outlines & ~near(found, tolerance)." must_say=["missed", "tolerance|near"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result |= padded[row : row + height, col : col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges == 255
    tp = (found & near(outlines, tolerance)).sum()
    fp = (found & ~near(outlines, tolerance)).sum()
    fn = (outlines & ~found).sum()
    if tp == 0:
        return 0.0
    precision = tp / (tp + fp)
    recall = tp / (tp + fn)
    return 2 * precision * recall / (precision + recall)
