# %% [markdown]
# # edges-near

# %%
def combined(mask, tolerance, is_in_window=lambda row, col: True):
    """True at each pixel that has a True pixel at one of the accepted distances (row, col)."""
    height, width = mask.shape
    p = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for r in range(-tolerance, tolerance + 1):
        for c in range(-tolerance, tolerance + 1):
            if is_in_window(r, c):
                result |= p[tolerance + r : tolerance + r + height, tolerance + c : tolerance + c + width]
    return result

# %% role="mistake" name="tolerance not used" says="You returned the mask unchanged. The neighbours of a True pixel are near it, too: up to tolerance rows and columns away."
def near(mask, tolerance):
    return mask.copy()

# %% role="mistake" name="always 1 pixel" says="Your function always looks 1 pixel far. Use the argument tolerance."
def near(mask, tolerance):
    return combined(mask, 1)

# %% role="mistake" name="a cross" says="Only the pixels of a cross were accepted, those in the same row or column. Use the whole square, corners included."
def near(mask, tolerance):
    return combined(mask, tolerance, lambda row, col: row == 0 or col == 0)

# %% role="mistake" name="a circle" says="Pixels in the corners of the square are missing, as if the distance was measured in a circle. Use the whole square: at most tolerance rows and at most tolerance columns."
def near(mask, tolerance):
    return combined(mask, tolerance, lambda row, col: row**2 + col**2 <= tolerance**2)

# %% role="mistake" name="range(3)" says="Your square always has 3 rows and columns, as with range(3); this is right for tolerance 1 alone. It needs 2 * tolerance + 1 of each: tolerance on both sides of the pixel, and the pixel itself."
def near(mask, tolerance):
    height, width = mask.shape
    padded, result = np.pad(mask, tolerance), np.zeros_like(mask)
    for row, col in np.ndindex(3, 3):
        result |= padded[row : row + height, col : col + width]
    return result

# %% role="mistake" name="np.roll across the border" says="Pixels at one border counted as near the opposite border, as with np.roll. Pad with False and take shifted slices instead."
def near(mask, tolerance):
    sides = range(-tolerance, tolerance + 1)
    return np.any([np.roll(mask, (row, col), axis=(0, 1)) for row in sides for col in sides], axis=0)

# %% role="mistake" name="a negative slice at the border" says="Near the top and the left border the window is empty, because row - tolerance is negative there. Pad the mask with False first, or use max(row - tolerance, 0)."
def near(mask, tolerance):
    result = np.zeros_like(mask)
    for row, col in np.ndindex(mask.shape):
        rows = slice(row - tolerance, row + tolerance + 1)
        result[row, col] = mask[rows, col - tolerance : col + tolerance + 1].any()
    return result

# %% role="mistake" name="the border left out" says="The pixels on the border are always False, as if they were left out. Pad the mask with False, and visit every pixel."
def near(mask, tolerance):
    inside = np.zeros_like(mask)
    height, width = mask.shape
    inside[tolerance : height - tolerance, tolerance : width - tolerance] = True
    return combined(mask, tolerance) & inside

# %% role="mistake" name="grows while it looks" says="Too many pixels are True, as if the function reads the array that it writes: new True pixels make more True pixels. Read the mask, and write into a new array."
def near(mask, tolerance):
    result = mask.copy()
    for row, col in np.ndindex(mask.shape):
        top, left = max(row - tolerance, 0), max(col - tolerance, 0)
        result[row, col] = result[top : row + tolerance + 1, left : col + tolerance + 1].any()
    return result

# %% role="mistake" name="the last slice alone" says="Your result is only the last shifted slice. Combine all slices: result = result | slice."
def near(mask, tolerance):
    return combined(mask, tolerance, lambda row, col: row == col == tolerance)

# %% [markdown]
# # edges-f1

# %%
def window(mask, tolerance, steps=None):
    """True at each pixel that has a True pixel in one of the (row, col) steps; the whole square if omitted."""
    height, width = mask.shape
    p = np.pad(mask, tolerance)
    sides = range(2 * tolerance + 1)
    starts = [(r, c) for r in sides for c in sides]
    if steps is not None:
        starts = [(r, c) for r, c in starts if steps(r - tolerance, c - tolerance)]
    return np.any([p[r : r + height, c : c + width] for r, c in starts] or [np.zeros_like(mask)], axis=0)

def counts(edges, outlines, tolerance, near=window):
    """Edge pixels near an outline, edge pixels, outline pixels near an edge, outline pixels."""
    mask = edges > 0
    hits, detected = mask & near(outlines, tolerance), outlines & near(mask, tolerance)
    return [int(part.sum()) for part in (hits, mask, detected, outlines)]

def f1_of(hits, edge_count, detected, outline_count):
    """F1 of four numbers of pixels; 0.0 where it would divide by 0."""
    if not edge_count or not outline_count or hits + detected == 0:
        return 0.0
    precision, recall = hits / edge_count, detected / outline_count
    return 2 * precision * recall / (precision + recall)

# %% role="mistake" name="precision alone" says="That is the precision. F1 also needs the recall: it is the harmonic mean of both."
def f1_score(edges, outlines, tolerance):
    hits, edge_count, _, _ = counts(edges, outlines, tolerance)
    return hits / edge_count if edge_count else 0.0

# %% role="mistake" name="recall alone" says="That is the recall. F1 also needs the precision: it is the harmonic mean of both."
def f1_score(edges, outlines, tolerance):
    _, _, detected, outline_count = counts(edges, outlines, tolerance)
    return detected / outline_count if outline_count else 0.0

# %% role="mistake" name="always 1 pixel" says="Your function always uses 1 pixel. Use the argument tolerance: another call has another tolerance."
def f1_score(edges, outlines, tolerance):
    return solution(edges, outlines, 1)

# %% role="mistake" name="the plain mean" says="That is the arithmetic mean of precision and recall. F1 is their harmonic mean, which is low if one of them is low."
def f1_score(edges, outlines, tolerance):
    hits, edge_count, detected, outline_count = counts(edges, outlines, tolerance)
    if not edge_count or not outline_count:
        return 0.0
    return (hits / edge_count + detected / outline_count) / 2

# %% role="mistake" name="the sum" says="You returned the sum of precision and recall. F1 is 2 * precision * recall, divided by this sum."
def f1_score(edges, outlines, tolerance):
    hits, edge_count, detected, outline_count = counts(edges, outlines, tolerance)
    if not edge_count or not outline_count:
        return 0.0
    return hits / edge_count + detected / outline_count

# %% role="mistake" name="edge pixels counted as 255" says="The edge pixels were counted 255 times, because edges holds 0 and 255. Make a mask first, edges > 0, and count with it."
def f1_score(edges, outlines, tolerance):
    hits, edge_count, detected, outline_count = counts(edges, outlines, tolerance)
    return f1_of(hits, 255 * edge_count, detected, outline_count)

# %% role="mistake" name="recall divided by the number of edges" says="Recall was divided by the number of edge pixels. It is a share of the outline pixels: divide by outlines.sum()."
def f1_score(edges, outlines, tolerance):
    hits, edge_count, detected, _ = counts(edges, outlines, tolerance)
    return f1_of(hits, edge_count, detected, edge_count)

# %% role="mistake" name="the grown masks counted" says="The pixels of the grown masks were counted. Count only the edge pixels and the outline pixels themselves: edge pixels & grown outlines, outline pixels & grown edges."
def f1_score(edges, outlines, tolerance):
    grown_edges, grown_outlines = window(edges > 0, tolerance), window(outlines, tolerance)
    both = int((grown_edges & grown_outlines).sum())
    return f1_of(both, int(grown_edges.sum()), both, int(grown_outlines.sum()))

# %% role="mistake" name="pairs of pixels" says="You counted pairs of an edge pixel and an outline pixel, so one pixel can count several times. Count each pixel once: stop after its first near pixel (break), or use any."
def f1_score(edges, outlines, tolerance):
    mask, height, width = edges > 0, *edges.shape
    p, sides = np.pad(outlines, tolerance), range(2 * tolerance + 1)
    pairs = sum(int((mask & p[r : r + height, c : c + width]).sum()) for r in sides for c in sides)
    return f1_of(pairs, int(mask.sum()), pairs, int(outlines.sum()))

# %% role="mistake" name="a cross" says="Only pixels in the same row or in the same column were accepted. A pixel may be away in rows and in columns at once: use the whole square, corners included."
def f1_score(edges, outlines, tolerance):
    def cross(mask, tolerance):
        return window(mask, tolerance, lambda row, col: row == 0 or col == 0)

    return f1_of(*counts(edges, outlines, tolerance, cross))

# %% role="mistake" name="divides by zero" says="Without edges, without outlines, or without true positives the function divides by 0. Return 0.0 before you divide."
def f1_score(edges, outlines, tolerance):
    hits, edge_count, detected, outline_count = counts(edges, outlines, tolerance)
    precision, recall = hits / edge_count, detected / outline_count
    return 2 * precision * recall / (precision + recall)

# %% role="mistake" name="no edges gives nan" says="Without edges the result is nan, because the function divides by 0. Return 0.0 before you divide."
def f1_score(edges, outlines, tolerance):
    return solution(edges, outlines, tolerance) if edges.any() else float("nan")

# %% role="mistake" name="no outlines gives nan" says="Without outlines the result is nan, because the function divides by 0. Return 0.0 before you divide."
def f1_score(edges, outlines, tolerance):
    return solution(edges, outlines, tolerance) if outlines.any() else float("nan")

# %% role="mistake" name="no true positives gives nan" says="If no edge is near an outline, precision + recall is 0, and 0 / 0 gives nan. Return 0.0 before you divide."
def f1_score(edges, outlines, tolerance):
    if not edges.any() or not outlines.any():
        return 0.0
    return solution(edges, outlines, tolerance) or float("nan")

# %% role="mistake" name="the geometric mean" says="That is the geometric mean, the square root of precision * recall. F1 is their harmonic mean: 2 * precision * recall / (precision + recall)."
def f1_score(edges, outlines, tolerance):
    hits, edge_count, detected, outline_count = counts(edges, outlines, tolerance)
    if not edge_count or not outline_count:
        return 0.0
    return (hits / edge_count * detected / outline_count) ** 0.5

# %% role="mistake" name="parentheses missing" says="Parentheses are missing: Python divides by precision alone, and adds recall afterwards. Write 2 * precision * recall / (precision + recall)."
def f1_score(edges, outlines, tolerance):
    hits, edge_count, detected, outline_count = counts(edges, outlines, tolerance)
    if not edge_count or not outline_count or not hits:
        return 0.0
    return 3 * detected / outline_count

# %% role="mistake" name="no tolerance for the recall" says="The recall was computed without the tolerance: an outline pixel is detected if an edge pixel is near it."
def f1_score(edges, outlines, tolerance):
    hits, edge_count, _, outline_count = counts(edges, outlines, tolerance)
    return f1_of(hits, edge_count, int(((edges > 0) & outlines).sum()), outline_count)

# %% role="mistake" name="no tolerance for the precision" says="The precision was computed without the tolerance: an edge pixel counts if an outline pixel is near it."
def f1_score(edges, outlines, tolerance):
    _, edge_count, detected, outline_count = counts(edges, outlines, tolerance)
    return f1_of(int(((edges > 0) & outlines).sum()), edge_count, detected, outline_count)
