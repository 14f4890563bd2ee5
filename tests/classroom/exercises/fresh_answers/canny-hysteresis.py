# %% name="only one step" origin="fresh" sentence="One step is not enough: repeat it until nothing changes." must_say=["repeat|until|one step|again|chain|once"] must_not_say=["corner|4-connect|uint8"] kind="value"
def grow_once(edges, weak):
    height, width = edges.shape
    padded = np.pad(edges, 1)
    near_edge = np.zeros_like(edges)
    for row in range(3):
        for col in range(3):
            near_edge |= padded[row:row + height, col:col + width]
    return edges | (weak & near_edge)


def grow(weak, strong):
    edges = grow_once(strong, weak)
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="400 steps" origin="fresh" sentence="400 steps are not enough for every image: repeat until nothing changes." must_say=["until|400|nothing changes|enough|longer"] must_not_say=["corner|uint8"] kind="value"
def grow_once(edges, weak):
    height, width = edges.shape
    padded = np.pad(edges, 1)
    near_edge = np.zeros_like(edges)
    for row in range(3):
        for col in range(3):
            near_edge |= padded[row:row + height, col:col + width]
    return edges | (weak & near_edge)


def grow(weak, strong):
    edges = strong
    for step in range(400):
        edges = grow_once(edges, weak)
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="weak are all edges" origin="fresh" sentence="Not every weak pixel is an edge: only those that a chain joins to a strong pixel." must_say=["weak|chain|connected|touch"] must_not_say=["corner|400|until"] kind="value"
def grow(weak, strong):
    edges = weak | strong
    return np.where(edges, 255, 0).astype(np.uint8)

# %% name="only right and below" origin="fresh" sentence="A neighbour can be on all eight sides; you never look at the diagonal neighbours." must_say=["corner|diagonal|eight|8"] must_not_say=["uint8"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    height, width = edges.shape
    while True:
        padded = np.pad(edges, 1)
        beside = padded[:-2, 1:-1] | padded[2:, 1:-1] | padded[1:-1, :-2] | padded[1:-1, 2:]
        new = edges | (weak & beside)
        if (new == edges).all():
            break
        edges = new
    return edges.astype(np.uint8) * 255

# %% name="grow_once not copied" origin="fresh" sentence="grow_once is not defined in this cell: copy its definition here, because grading runs only this cell." must_say=["grow_once|copy|definition|defined|this cell|only this"] kind="missing-import"
def grow(weak, strong):
    edges = strong
    while True:
        new = grow_once(edges, weak)
        if np.array_equal(new, edges):
            return np.where(edges, 255, 0).astype(np.uint8)
        edges = new
