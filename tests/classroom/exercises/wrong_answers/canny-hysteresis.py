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
