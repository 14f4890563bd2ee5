# %% name="no border" origin="new" sentence="The border must be black: look at it first." must_say=["border"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
    return -1, 0

# %% name="words turned" origin="new" sentence="The turns of the read cells count, not those of the word: you turned to the other side." must_say=["other side|read cells|left"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (inside == np.rot90(words[number], turns)).all():
                return number, turns
    return -1, 0

# %% name="never turned" origin="new" sentence="Try the cells in all four turns." must_say=["turn|quarter"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for number in range(len(words)):
        if (inside == words[number]).all():
            return number, 0
    return -1, 0

# %% name="range 1 to 4" origin="new" sentence="An upright marker has 0 turns: use range(4)." must_say=["range\\(4\\)|0 turns"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(1, 5):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
    return -1, 0

# %% name="range 3" origin="new" sentence="One turn is missing: range(4)." must_say=["range\\(4\\)|turn"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(3):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
    return -1, 0

# %% name="turns first" origin="new" sentence="Return the number first, then the turns." must_say=["order|first"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return 0, -1
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return turns, number
    return 0, -1

# %% name="number alone" origin="new" sentence="Return two numbers: the turns are missing." must_say=["two|turns"] kind="type"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number
    return -1

# %% name="degrees" origin="new" sentence="Return quarter turns, not degrees." must_say=["degree|quarter"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns * 90
    return -1, 0

# %% name="no last return" origin="new" sentence="If no word fits, return (-1, 0)." must_say=["-1"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns

# %% name="0 if nothing fits" origin="new" sentence="0 is a marker's number: return (-1, 0) if no word fits." must_say=["-1"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return 0, 0
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
    return 0, 0

# %% name="any in place of all" origin="new" sentence="All 16 cells must be equal: use all, not any." must_say=["\\ball\\b|\\.all"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).any():
                return number, turns
    return -1, 0

# %% name="truth of an array" origin="new" sentence="A comparison of arrays gives many values: use .all()." must_say=["\\ball\\b|\\.all"] kind="error"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if np.rot90(inside, turns) == words[number]:
                return number, turns
    return -1, 0

# %% name="nearest word" origin="new" sentence="All 16 cells must be equal, not only most of them." must_say=["all 16|must be equal"] kind="value"
def decode(cells, words):
    best = -1, 0
    most = 0
    for turns in range(4):
        for number in range(len(words)):
            equal = (np.rot90(cells[1:5, 1:5], turns) == words[number]).sum()
            if equal > most:
                most = equal
                best = number, turns
    return best

# %% name="first row of the border" origin="new" sentence="The border has four sides: look also at the columns." must_say=["border|column"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells[0].sum() > 0 or cells[5].sum() > 0:
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
    return -1, 0

# %% name="else return" origin="new" sentence="You give up after the first word: return (-1, 0) only after both loops." must_say=["after|first|loop"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
            else:
                return -1, 0

# %% name="fifty words assumed" origin="new" sentence="The number of words is len(words): not every call has 50." must_say=["length|len\\("] kind="error" must_not_say=["np.pad", "pixel"]
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for number in range(50):
        for turns in range(4):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
    return -1, 0
