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

# %% name="Takes only one step" origin="fresh" sentence="Takes only one step, so only weak pixels that touch a strong pixel directly become edges." must_say=["one step"] kind="value"
def grow(weak, strong):
    height, width = strong.shape
    padded = np.pad(strong, 1)
    near = np.zeros(strong.shape, dtype=bool)
    for i in range(3):
        for j in range(3):
            near = near | padded[i:i + height, j:j + width]
    edges = strong | (weak & near)
    return edges.astype(np.uint8) * 255

# %% name="Repeats a fixed 400 times instead of until nothing changes" origin="fresh" sentence="Repeats a fixed 400 times instead of until nothing changes, so longer chains are not finished." must_say=["fixed"] kind="value"
def grow_once(edges, weak):
    height, width = edges.shape
    padded = np.pad(edges, 1)
    near = np.zeros(edges.shape, dtype=bool)
    for i in range(3):
        for j in range(3):
            near = near | padded[i:i + height, j:j + width]
    return edges | (weak & near)

def grow(weak, strong):
    edges = strong.copy()
    for step in range(400):
        edges = grow_once(edges, weak)
    return edges.astype(np.uint8) * 255

# %% name="Looks only at the four side neighbours" origin="fresh" sentence="Looks only at the four side neighbours; pixels that touch at a corner are forgotten." must_say=["four"] kind="value"
def grow(weak, strong):
    edges = strong.copy()
    while True:
        padded = np.pad(edges, 1)
        near = padded[:-2, 1:-1] | padded[2:, 1:-1] | padded[1:-1, :-2] | padded[1:-1, 2:]
        new = edges | (weak & near)
        if np.array_equal(new, edges):
            break
        edges = new
    return edges.astype(np.uint8) * 255

# %% name="Returns the bool array" origin="fresh" sentence="Returns the bool array; a uint8 image with 0 and 255 is wanted." must_say=["bool"] kind="dtype"
def grow(weak, strong):
    height, width = strong.shape
    edges = strong.copy()
    changed = True
    while changed:
        padded = np.pad(edges, 1)
        near = np.zeros(strong.shape, dtype=bool)
        for i in range(3):
            for j in range(3):
                near = near | padded[i:i + height, j:j + width]
        new = edges | (weak & near)
        changed = (new != edges).any()
        edges = new
    return edges

# %% name="The mask weak is forgotten" origin="fresh" sentence="The mask weak is forgotten: the edges grow into every neighbour until the whole image is white." must_say=["weak"] kind="value"
def grow(weak, strong):
    height, width = strong.shape
    edges = strong.copy()
    while True:
        padded = np.pad(edges, 1)
        near = np.zeros(strong.shape, dtype=bool)
        for i in range(3):
            for j in range(3):
                near = near | padded[i:i + height, j:j + width]
        new = edges | near
        if (new == edges).all():
            break
        edges = new
    return edges.astype(np.uint8) * 255

# %% name="edges = strong makes no copy" origin="fresh" sentence="edges = strong makes no copy, so the given array strong is changed." must_say=["copy|changed"] kind="input-changed"
def grow(weak, strong):
    height, width = strong.shape
    edges = strong
    todo = [(r, c) for r, c in np.argwhere(strong)]
    while todo:
        row, col = todo.pop()
        for r in range(max(row - 1, 0), min(row + 2, height)):
            for c in range(max(col - 1, 0), min(col + 2, width)):
                if weak[r, c] and not edges[r, c]:
                    edges[r, c] = True
                    todo.append((r, c))
    return edges.astype(np.uint8) * 255

# %% name="Does not test for negative indices" origin="fresh" sentence="Does not test for negative indices, so at the top and left border the search jumps to the opposite side." must_say=["negative|below 0|opposite"] kind="value"
def grow(weak, strong):
    height, width = strong.shape
    result = np.zeros((height, width), dtype=np.uint8)
    result[strong] = 255
    todo = list(np.argwhere(strong))
    while len(todo) > 0:
        row, col = todo.pop()
        for dr in [-1, 0, 1]:
            for dc in [-1, 0, 1]:
                r = row + dr
                c = col + dc
                if r < height and c < width:
                    if weak[r, c] and result[r, c] == 0:
                        result[r, c] = 255
                        todo.append((r, c))
    return result

# %% name="The factor 255 is forgotten" origin="fresh" sentence="The factor 255 is forgotten, so edges are 1 and not 255." must_say=["255"] kind="value"
def grow(weak, strong):
    height, width = strong.shape
    edges = strong.copy()
    while True:
        before = edges.sum()
        padded = np.pad(edges, 1)
        near = np.zeros(strong.shape, dtype=bool)
        for i in range(3):
            for j in range(3):
                near = near | padded[i:i + height, j:j + width]
        edges = edges | (weak & near)
        if edges.sum() == before:
            break
    return edges.astype(np.uint8)

# %% name="Weak pixels on the border of the image are skipped" origin="fresh" sentence="Weak pixels on the border of the image are skipped, so they never become edges." must_say=["border"] kind="value"
def grow(weak, strong):
    height, width = strong.shape
    edges = strong.copy()
    changed = True
    while changed:
        changed = False
        for row, col in np.argwhere(weak & ~edges):
            if 0 < row < height - 1 and 0 < col < width - 1:
                if edges[row - 1:row + 2, col - 1:col + 2].any():
                    edges[row, col] = True
                    changed = True
    return edges.astype(np.uint8) * 255

# %% name="Every weak pixel becomes an edge" origin="fresh" sentence="Every weak pixel becomes an edge, also those without a connection to a strong pixel." must_say=["every weak|all weak"] kind="value"
def grow(weak, strong):
    edges = np.zeros(weak.shape, dtype=np.uint8)
    edges[strong] = 255
    edges[weak] = 255
    return edges
