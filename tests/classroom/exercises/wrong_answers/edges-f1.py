# %% name="no edges divides by zero" sentence="Without edges (or outlines) you divide by 0: return 0.0 in that case before you divide." must_say=["zero|\\b0\\b|\\bnan\\b|empty", "divi|return", "no edges|without edges|no outlines|empty|outlines"] must_not_say=["255"] kind="error"
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

# %% name="score of another cell" sentence="share_near is defined in another cell (and works for 2 pixels only): compute the shares inside your own cell." must_say=["share_near|another cell|other cell", "cell|own|inside|copy|define"] kind="other-cell"
def f1_score(edges, outlines, tolerance):
    found = edges > 0
    precision, recall = share_near(found, outlines), share_near(outlines, found)
    return 2 * precision * recall / max(precision + recall, 1e-9)

# %% name="sklearn's f1_score" sentence="sklearn's f1_score knows no tolerance and is refused here: compute precision and recall yourself." must_say=["sklearn|scikit|library", "refus|tolerance|yourself|not allowed|forbid"] kind="refused"
from sklearn import metrics


def f1_score(edges, outlines, tolerance):
    return float(metrics.f1_score(outlines.ravel(), edges.ravel() > 0))

# %% name="IoU" sentence="Intersection over union is another measure (IoU): F1 is computed from precision and recall." must_say=["union|IoU|jaccard|another measure", "precision|recall|F1"] kind="value"
def f1_score(edges, outlines, tolerance):
    found = edges > 0
    union = (found | outlines).sum()
    if union == 0:
        return 0.0
    return float((found & outlines).sum() / union)

# %% name="print instead of return" sentence="You print F1 and return nothing: use return." must_say=["return", "print"] kind="no-return"
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
