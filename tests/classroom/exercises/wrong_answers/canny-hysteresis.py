# %% name="one sweep from the top left" origin="walk" sentence="One sweep over the image is not enough: a chain that runs up or to the left is not followed, so repeat until nothing changes." must_say=["sweep|one pass|single pass|up or|to the left|upwards", "repeat|until|again|while"] must_not_say=["corner"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    h, w = weak.shape
    for y in range(h):
        for x in range(w):
            if weak[y, x] and edges[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2].any():
                edges[y, x] = True
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="four neighbours" origin="walk" sentence="You look at four neighbours only; pixels that touch at a corner count too, so look at all eight." must_say=["four|\\b4\\b|corner|diagonal", "eight|\\b8\\b|corner|diagonal"] must_not_say=["repeat"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    while True:
        p = np.pad(edges, 1)
        near = p[1:-1, :-2] | p[1:-1, 2:] | p[:-2, 1:-1] | p[2:, 1:-1]
        new = edges | (weak & near)
        if (new == edges).all():
            break
        edges = new
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="one step of growth" origin="walk" sentence="You grow by one step only; edges grow along the whole chain, so repeat the step until nothing changes." must_say=["one step|only once|single step|by one", "repeat|until|again|while|whole chain"] must_not_say=["corner"] kind="value"
def grow(weak, strong):
    p = np.pad(strong, 1)
    h, w = strong.shape
    near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
    return np.where(strong | (weak & near), 255, 0).astype(np.uint8)

# %% name="bool result" origin="new" sentence="The edges are right, but they are bool: the task asks for uint8, 255 where an edge is and 0 elsewhere." must_say=["bool|True and False", "255|uint8"] must_not_say=["repeat", "corner"] kind="dtype"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    for _ in range(h * w):
        p = np.pad(edges, 1)
        near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
        new = edges | (weak & near)
        if (new == edges).all():
            break
        edges = new
    return edges

# %% name="0 and 1 instead of 0 and 255" origin="new" sentence="astype(np.uint8) makes 1 of True; an edge must be 255: use np.where(edges, 255, 0), or multiply by 255." must_say=["\\b1\\b", "255"] must_not_say=["repeat", "corner"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    for _ in range(h * w):
        p = np.pad(edges, 1)
        near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
        new = edges | (weak & near)
        if (new == edges).all():
            break
        edges = new
    return edges.astype(np.uint8)

# %% name="weak pixels all kept" origin="new" sentence="You keep every weak pixel; a weak pixel is an edge only if a chain leads from it to a strong one." must_say=["every weak|all (the )?weak|weak", "chain|connect|touch|leads", "only if|unless|every|all|not"] must_not_say=["corner"] kind="value"
def grow(weak, strong):
    return np.where(weak | strong, 255, 0).astype(np.uint8)

# %% name="only the strong pixels" origin="new" sentence="You return the strong pixels alone; the weak pixels that are connected with them are edges, too." must_say=["strong pixels alone|alone|only the strong|only strong", "weak|candidate|grow"] kind="value"
def grow(weak, strong):
    return np.where(strong, 255, 0).astype(np.uint8)

# %% name="grows over everything" origin="new" sentence="Your edges grow over pixels that are neither weak nor strong: keep a new pixel only where weak is True." must_say=["weak|candidate", "neither|not weak|over|only where|everything|limit|&"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    for _ in range(h + w):
        p = np.pad(edges, 1)
        edges = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="fixed number of steps" origin="new" sentence="You grow a fixed number of 10 steps; a long chain needs more, so repeat until nothing changes." must_say=["fixed|\\b10\\b|number of steps|enough", "until|while|no more|nothing changes|long|chain"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    for _ in range(10):
        p = np.pad(edges, 1)
        near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
        edges = edges | (weak & near)
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="strong pixels lost" origin="new" sentence="In your loop a new step keeps only the weak pixels, and the strong ones are lost: combine with | so that edges stay edges." must_say=["strong|seed|edges", "are lost|lose|disappear|stay|\\|"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    only_weak = weak & ~strong
    for _ in range(h * w):
        p = np.pad(edges, 1)
        near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
        new = only_weak & near
        if (new == edges).all():
            break
        edges = new
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="arguments exchanged" origin="new" sentence="You start from the weak pixels and grow into the strong ones; it is the other way round: start from strong." must_say=["weak", "strong", "other way|swap|exchang|start from|revers"] kind="value"
def grow(weak, strong):
    edges = weak.copy()
    h, w = edges.shape
    for _ in range(h * w):
        p = np.pad(edges, 1)
        near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
        new = edges | (strong & near)
        if (new == edges).all():
            break
        edges = new
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="wraps at the border" origin="new" sentence="np.roll connects the left border with the right one and the top with the bottom: pad with False and take slices instead." must_say=["roll|opposite|wrap|other side|left border with", "pad|slice|border"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    while True:
        near = np.zeros_like(edges)
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                near |= np.roll(edges, (dy, dx), axis=(0, 1))
        new = edges | (weak & near)
        if (new == edges).all():
            break
        edges = new
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="border pixels never grow" origin="new" sentence="Your loop leaves the border pixels out, so a chain along the border is not followed: pad the image, or cut the window at the border." must_say=["border|outermost", "leaves?|left out|visit|along|never|inner|not followed", "pad|cut|visit|all|limit"] must_not_say=["corner"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    changed = True
    while changed:
        changed = False
        for y in range(1, h - 1):
            for x in range(1, w - 1):
                if weak[y, x] and not edges[y, x] and edges[y - 1 : y + 2, x - 1 : x + 2].any():
                    edges[y, x] = True
                    changed = True
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="index outside at the border" origin="new" sentence="edges[y + 1, x + 1] is outside the image at the lower and right border: check the limits, or pad first." must_say=["outside|out of (bounds|range)|beyond", "pad|check|limit|border"] kind="error"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    changed = True
    while changed:
        changed = False
        for y in range(h):
            for x in range(w):
                if weak[y, x] and not edges[y, x]:
                    for dy in (-1, 0, 1):
                        for dx in (-1, 0, 1):
                            if edges[y + dy, x + dx]:
                                edges[y, x] = True
                                changed = True
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="strong changed in place" origin="new" sentence="edges = strong is only another name for the same array, so the input is changed: write edges = strong.copy()." must_say=["input|strong\\.copy|strong .*chang|caller", "copy"] kind="input-changed"
def grow(weak, strong):
    edges = strong
    h, w = edges.shape
    changed = True
    while changed:
        changed = False
        for y in range(h):
            for x in range(w):
                if weak[y, x] and not edges[y, x] and edges[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2].any():
                    edges[y, x] = True
                    changed = True
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="loop that never ends" origin="new" sentence="Your loop never ends: it waits until no weak pixel touches an edge, but the pixels that are edges already still touch; stop when a step changed nothing." must_say=["never ends|endless|for ever|forever|never stops", "step|chang|new pixel"] kind="too-slow"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    while True:
        p = np.pad(edges, 1)
        near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
        touched = weak & near
        if not touched.any():
            break
        edges = edges | touched
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="compared with itself, one step" origin="new" sentence="old = edges is the same array, so old and edges are always equal and the loop stops after one step: write old = edges.copy()." must_say=["same array|itself|always equal|another name", "copy", "old|one step|equal|stops|compar"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    while True:
        old = edges
        p = np.pad(edges, 1)
        near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
        edges |= weak & near
        if (old == edges).all():
            break
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="grow_once of the lesson" origin="new" sentence="grow_once is defined in another cell: copy its definition into this cell." must_say=["grow_once", "copy|define|cell"] kind="other-cell"
def grow(weak, strong):
    edges = strong
    for _ in range(weak.size):
        edges = grow_once(edges, weak) | strong
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="cv2 finds the components" origin="new" sentence="cv2 is refused in this task: let the edges grow step by step with NumPy." must_say=["cv2|opencv", "refus|not allowed|numpy|yourself|by hand|forbid"] kind="refused"
import cv2


def grow(weak, strong):
    both = (weak | strong).astype(np.uint8)
    _, labels = cv2.connectedComponents(both, connectivity=8)
    keep = np.unique(labels[strong])
    return np.where(np.isin(labels, keep) & (both > 0), 255, 0).astype(np.uint8)

# %% name="scipy finds the components" origin="new" sentence="scipy is refused in this task: let the edges grow step by step with NumPy." must_say=["scipy|ndimage", "refus|not allowed|numpy|yourself|by hand|forbid"] kind="refused"
from scipy import ndimage


def grow(weak, strong):
    labels, _ = ndimage.label(weak | strong, structure=np.ones((3, 3)))
    keep = np.unique(labels[strong])
    return np.where(np.isin(labels, keep[keep > 0]), 255, 0).astype(np.uint8)

# %% name="window cut one short" origin="new" sentence="The slice y - 1 : y + 1 ends before y + 1, so the row below and the column to the right are not looked at: write y + 2 and x + 2." must_say=["slice|ends? before|too small|y ?\\+ ?2|window", "y ?\\+ ?2|x ?\\+ ?2|below|row|three"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    changed = True
    while changed:
        changed = False
        for y in range(h):
            for x in range(w):
                if weak[y, x] and not edges[y, x] and edges[max(y - 1, 0) : y + 1, max(x - 1, 0) : x + 1].any():
                    edges[y, x] = True
                    changed = True
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="recursion without a memory" origin="new" sentence="Your function calls itself for pixels that it has visited already, so it never ends: mark each pixel as an edge before you go on to its neighbours." must_say=["recurs|calls itself|visited", "mark|visited|already|memory"] kind="error"
def grow(weak, strong):
    h, w = weak.shape
    out = np.zeros((h, w), np.uint8)

    def visit(y, x):
        if not (0 <= y < h and 0 <= x < w) or not (weak[y, x] or strong[y, x]):
            return
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                if (dy, dx) != (0, 0):
                    visit(y + dy, x + dx)
        out[y, x] = 255

    for y, x in np.argwhere(strong):
        visit(y, x)
    return out

# %% name="return forgotten" origin="new" sentence="The edges are found and never given back: add return at the end." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    for _ in range(h * w):
        p = np.pad(edges, 1)
        near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
        new = edges | (weak & near)
        if (new == edges).all():
            break
        edges = new
    result = np.where(edges, 255, 0).astype(np.uint8)

# %% name="a hundred steps are enough" origin="new" sentence="100 steps are enough for the lesson's frame only; a longer chain needs more steps, so repeat until nothing changes." must_say=["\\b100\\b|fixed|number of steps|enough", "until|while|no more|nothing changes|long|chain"] must_not_say=["corner"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    h, w = edges.shape
    for _ in range(100):
        p = np.pad(edges, 1)
        near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
        edges = edges | (weak & near)
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="grow_once does not see the change" origin="walk" sentence="edges never changes in the loop, so grow_once gives the same result for ever: write edges = larger in the loop." must_say=["change|never ends|endless"] must_not_say=["corner"] kind="too-slow"
def grow_once(edges, weak):
    height, width = edges.shape
    padded = np.pad(edges, 1)
    near_edge = np.zeros_like(edges)
    for row in range(3):
        for col in range(3):
            near_edge |= padded[row : row + height, col : col + width]
    return edges | (weak & near_edge)


def grow(weak, strong):
    edges = strong
    larger = grow_once(edges, weak)
    while larger.sum() != edges.sum():
        larger = grow_once(edges, weak)
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="return in the while loop at once" origin="walk" sentence="edges.sum() == edges.sum() is always true, so the loop ends after one step: keep the number of edge pixels before the step." must_say=["itself|always true"] must_not_say=["corner"] kind="value"
def grow_once(edges, weak):
    height, width = edges.shape
    padded = np.pad(edges, 1)
    near_edge = np.zeros_like(edges)
    for row in range(3):
        for col in range(3):
            near_edge |= padded[row : row + height, col : col + width]
    return edges | (weak & near_edge)


def grow(weak, strong):
    edges = strong
    while True:
        edges = grow_once(edges, weak)
        if edges.sum() == edges.sum():
            return np.where(edges, 255, 0).astype(np.uint8)

# %% name="while edges != larger" origin="walk" sentence="edges != larger is an array, and while needs one True or False: write (edges != larger).any()." must_say=["any\\(\\)"] must_not_say=["corner"] kind="error"
def grow_once(edges, weak):
    height, width = edges.shape
    padded = np.pad(edges, 1)
    near_edge = np.zeros_like(edges)
    for row in range(3):
        for col in range(3):
            near_edge |= padded[row : row + height, col : col + width]
    return edges | (weak & near_edge)


def grow(weak, strong):
    edges = strong
    larger = grow_once(edges, weak)
    while edges != larger:
        edges = larger
        larger = grow_once(edges, weak)
    return np.where(edges, 255, 0).astype(np.uint8)
