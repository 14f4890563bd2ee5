# %% name="sklearn's f1_score" sentence="sklearn's f1_score knows no tolerance and is refused here: compute precision and recall yourself." must_say=["sklearn|scikit|library", "refus|tolerance|yourself|not allowed|forbid"] kind="refused"
from sklearn import metrics


def f1_score(edges, outlines, tolerance):
    return float(metrics.f1_score(outlines.ravel(), edges.ravel() > 0))
