# %% name="no border" sentence="The border must be black: look at it first." must_say=["border"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
    return -1, 0

# %% name="number alone" sentence="Return two numbers: the turns are missing." must_say=["two|turns"] kind="type"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number
    return -1

# %% name="truth of an array" sentence="A comparison of arrays gives many values: use .all()." must_say=["\\ball\\b|\\.all"] kind="error"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if np.rot90(inside, turns) == words[number]:
                return number, turns
    return -1, 0

# %% name="words turned" sentence="The turns of the read cells count, not those of the word: you turned to the other side." must_say=["other side|read cells|left"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (inside == np.rot90(words[number], turns)).all():
                return number, turns
    return -1, 0

# %% name="degrees" sentence="Return quarter turns, not degrees." must_say=["degree|quarter"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    if cells.sum() != inside.sum():
        return -1, 0
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns * 90
    return -1, 0
