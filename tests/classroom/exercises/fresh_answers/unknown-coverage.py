# %% name="multiplied by 0.5" origin="fresh" sentence="Divide x and y by 0.5: a cell is 0.5 m wide." must_say=["divide|0\\.5"] kind="value"
def coverage(path, cells):
    pairs = {(math.floor(x * 0.5), math.floor(y * 0.5)) for x, y, _ in path}
    reachable = {tuple(cell) for cell in cells.tolist()}
    return len(pairs & reachable) / len(reachable)

# %% name="rounded up" origin="fresh" sentence="floor rounds down; ceil rounds up." must_say=["floor|down"] kind="value"
def coverage(path, cells):
    pairs = {(math.ceil(x / 0.5), math.ceil(y / 0.5)) for x, y, _ in path}
    reachable = {tuple(cell) for cell in cells.tolist()}
    return len(pairs & reachable) / len(reachable)

# %% name="union of both" origin="fresh" sentence="& has what is in both sets; | has what is in one of them." must_say=["&|both"] kind="value"
def coverage(path, cells):
    pairs = {(math.floor(x / 0.5), math.floor(y / 0.5)) for x, y, _ in path}
    reachable = {tuple(cell) for cell in cells.tolist()}
    return len(pairs | reachable) / len(reachable)

# %% name="whole numbers divided" origin="fresh" sentence="// drops the fraction. Divide with /." must_say=["//|fraction|/"] kind="value"
def coverage(path, cells):
    pairs = {(math.floor(x / 0.5), math.floor(y / 0.5)) for x, y, _ in path}
    reachable = {tuple(cell) for cell in cells.tolist()}
    return len(pairs & reachable) // len(reachable)
