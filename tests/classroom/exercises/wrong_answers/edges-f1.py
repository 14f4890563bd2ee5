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

# %% name="sklearn's f1_score" sentence="sklearn's f1_score knows no tolerance and is refused here: compute precision and recall yourself." must_say=["sklearn|scikit|library", "refus|tolerance|yourself|not allowed|forbid"] kind="refused"
from sklearn import metrics


def f1_score(edges, outlines, tolerance):
    return float(metrics.f1_score(outlines.ravel(), edges.ravel() > 0))
