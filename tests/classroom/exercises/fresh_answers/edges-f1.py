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
