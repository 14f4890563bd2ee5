# %% name="one step of growth" sentence="You grow by one step only; edges grow along the whole chain, so repeat the step until nothing changes." must_say=["one step|only once|single step|by one", "repeat|until|again|while|whole chain"] must_not_say=["corner"] kind="value"
def grow(weak, strong):
    p = np.pad(strong, 1)
    h, w = strong.shape
    near = np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)
    return np.where(strong | (weak & near), 255, 0).astype(np.uint8)

# %% name="grow_once of the lesson" sentence="grow_once is defined in another cell: copy its definition into this cell." must_say=["grow_once", "copy|define|cell"] kind="other-cell"
def grow(weak, strong):
    edges = strong
    for _ in range(weak.size):
        edges = grow_once(edges, weak) | strong
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="scipy finds the components" sentence="scipy is refused in this task: let the edges grow step by step with NumPy." must_say=["scipy|ndimage", "refus|not allowed|numpy|yourself|by hand|forbid"] kind="refused"
from scipy import ndimage


def grow(weak, strong):
    labels, _ = ndimage.label(weak | strong, structure=np.ones((3, 3)))
    keep = np.unique(labels[strong])
    return np.where(np.isin(labels, keep[keep > 0]), 255, 0).astype(np.uint8)

# %% name="grow_once not copied" sentence="grow_once is not defined in this cell: copy its definition here, because grading runs only this cell." must_say=["grow_once|copy|definition|defined|this cell|only this"] kind="missing-import"
def grow(weak, strong):
    edges = strong
    while True:
        new = grow_once(edges, weak)
        if np.array_equal(new, edges):
            return np.where(edges, 255, 0).astype(np.uint8)
        edges = new

# %% name="bool result" sentence="The edges are right, but they are bool: the task asks for uint8, 255 where an edge is and 0 elsewhere." must_say=["bool|True and False", "255|uint8"] must_not_say=["repeat", "corner"] kind="dtype"
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
