# %% name="mean of precision and recall" origin="fresh" sentence="F1 is the harmonic mean 2PR / (P + R); you compute the ordinary mean." must_say=["harmonic|2 ?[*×]|ordinary|arithmetic|mean|average"] must_not_say=["divid.* by 0|tolerance"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    size = 2 * tolerance + 1
    for row in range(size):
        for col in range(size):
            result |= padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if found.sum() == 0 or outlines.sum() == 0:
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return (precision + recall) / 2

# %% name="same true positives twice" origin="fresh" sentence="Recall counts the outline pixels near an edge; you use the edge pixels near an outline for both." must_say=["recall|outline pixels|near an edge"] must_not_say=["harmonic|divi"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    size = 2 * tolerance + 1
    for row in range(size):
        for col in range(size):
            result |= padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if found.sum() == 0 or outlines.sum() == 0:
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (found & near(outlines, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="division by zero" origin="fresh" sentence="If there are no edges, you divide 0 by 0 and get nan: return 0.0 before you divide." must_say=["0\\.0|nan|divi|no edges|before|empty"] must_not_say=["harmonic"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    size = 2 * tolerance + 1
    for row in range(size):
        for col in range(size):
            result |= padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    return 2 * precision * recall / (precision + recall)

# %% name="factor 2 forgotten" origin="fresh" sentence="The 2 is missing: F1 = 2 * P * R / (P + R), your value is half of it." must_say=["2 ?[*×]|\\* 2|half|twice|factor|\\b2 "] must_not_say=["tolerance"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    size = 2 * tolerance + 1
    for row in range(size):
        for col in range(size):
            result |= padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if found.sum() == 0 or outlines.sum() == 0:
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return precision * recall / (precision + recall)

# %% name="edges & bool with 255" origin="fresh" sentence="edges holds 0 and 255, not True and False: first write edges > 0." must_say=["255|> 0|bool|mask|True"] must_not_say=["harmonic"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    size = 2 * tolerance + 1
    for row in range(size):
        for col in range(size):
            result |= padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges
    if found.sum() == 0 or outlines.sum() == 0:
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="parentheses of f1" origin="fresh" sentence="Only precision is divided... put the sum in parentheses." must_say=["parenthes"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result | padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / precision + recall

# %% name="mean of both" origin="fresh" sentence="F1 is not the mean of precision and recall: 2 * p * r / (p + r)." must_say=["F1|mean|precision"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result | padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    return (precision + recall) / 2

# %% name="edges as mask" origin="fresh" sentence="edges holds 0 and 255: make a mask of it first, edges > 0." must_say=["edges > 0|mask|bool|255"] kind="error"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result | padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    if not edges.any() or not outlines.any():
        return 0.0
    precision = (edges & near(outlines, tolerance)).sum() / edges.sum()
    recall = (outlines & near(edges, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="window without the last" origin="fresh" sentence="The window has 2 * tolerance + 1 rows: the last shift is missing." must_say=["\\+ 1|last|square|each direction|tolerance rows|one too small"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance):
        for col in range(2 * tolerance):
            result = result | padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="near without tolerance" origin="fresh" sentence="A tolerance is not used: an edge one pixel away counts, too." must_say=["tolerance|near|within"] kind="value"
def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    both = (found & outlines).sum()
    precision = both / found.sum()
    recall = both / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="divided by zero" origin="fresh" sentence="Without true positives return 0.0 before you divide." must_say=["0\\.0|divide"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result | padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    return 2 * precision * recall / (precision + recall)

# %% name="near not copied" origin="fresh" sentence="near is not defined in this cell: copy its definition into it." must_say=["copy|definition|near"] kind="error"
def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & nearby(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & nearby(found, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="recall as precision" origin="fresh" sentence="Recall is the share of the outline pixels that are near an edge, not the same count." must_say=["recall|outline"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result | padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    hits = (found & near(outlines, tolerance)).sum()
    precision, recall = hits / found.sum(), hits / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="returns inside near's loop" origin="fresh" sentence="return in near stands inside the loop: only one shift is used." must_say=["return.*(loop|inside)"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result | padded[row:row + height, col:col + width]
        return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found & near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines & near(found, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)

# %% name="and for &" origin="fresh" sentence="and needs single truth values: between masks write &." must_say=["&"] kind="error"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result | padded[row:row + height, col:col + width]
    return result


def f1_score(edges, outlines, tolerance):
    found = edges > 0
    if not found.any() or not outlines.any():
        return 0.0
    precision = (found and near(outlines, tolerance)).sum() / found.sum()
    recall = (outlines and near(found, tolerance)).sum() / outlines.sum()
    if precision + recall == 0:
        return 0.0
    return 2 * precision * recall / (precision + recall)
