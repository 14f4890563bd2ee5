# %% name="no border" sentence="The border must be black: look at it first." must_say=["border"] kind="value"
def decode(cells, words):
    inside = cells[1:5, 1:5]
    for turns in range(4):
        for number in range(len(words)):
            if (np.rot90(inside, turns) == words[number]).all():
                return number, turns
    return -1, 0

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
