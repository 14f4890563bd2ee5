# %% name="last is the blank" origin="fresh" sentence="The blank is the first character." must_say=["blank"] kind="value"
def decode(scores, characters):
    blank = len(characters) - 1
    text = ""
    before = blank
    for i in scores.argmax(axis=1):
        if i != before and i != blank:
            text += characters[i]
        before = i
    return text

# %% name="argmin" origin="fresh" sentence="The best score is the largest: argmax." must_say=["argmax|largest"] kind="value"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmin(axis=1):
        if i != before and i != 0:
            text += characters[i]
        before = i
    return text

# %% name="or" origin="fresh" sentence="Both must be true: new, and not blank." must_say=["blank|run|and"] kind="value"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmax(axis=1):
        if i != before or i != 0:
            text += characters[i]
        before = i
    return text

# %% name="added in front" origin="fresh" sentence="Add each character at the end." must_say=["end|backwards"] kind="value"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmax(axis=1):
        if i != before and i != 0:
            text = characters[i] + text
        before = i
    return text

# %% name="threshold" origin="fresh" sentence="Take the largest score of each row, not those above a threshold." must_say=["largest|argmax|best"] kind="value"
def decode(scores, characters):
    text = ""
    for row in scores:
        for i in range(1, len(row)):
            if row[i] > 0.6:
                text += characters[i]
    return text
