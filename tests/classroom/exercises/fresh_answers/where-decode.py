# %% name="wrong cut" origin="fresh" sentence="The word is rows 1 to 4: the end of a slice is not included, so 1:5." must_say=["1:5|rows 1|1 to 4|shape|four"] kind="value"
def decode(cells, words):
    inside = cells[1:4, 1:4]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if np.array_equal(np.rot90(inside, turns), words[number]):
                return number, turns
    return -1, 0

# %% name="the turn that is left" origin="fresh" sentence="All four turns are counted from 0, but you return the number of the turn that is left: 4 - turns." must_say=["turn|side"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, (4 - turns) % 4
    return -1, 0

# %% name="mirrored" origin="fresh" sentence=".T mirrors: turn with np.rot90." must_say=["rot90|turn|mirror"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5].T
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
    return -1, 0

# %% name="turns always 0" origin="fresh" sentence="Return how often you turned, not always 0." must_say=["turn"] kind="value"
def decode(cells, words):
    if cells.sum() != cells[1:5, 1:5].sum():
        return -1, 0
    for word_number, word in enumerate(words):
        for turns in range(4):
            if (np.rot90(cells[1:5, 1:5], turns) == word).all():
                return word_number, 0
    return -1, 0

# %% name="sums compared" origin="fresh" sentence="Compare the cells, not how many are white." must_say=["cells|equal"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if np.rot90(inside, turns).sum() == words[number].sum():
                return number, turns
    return -1, 0
