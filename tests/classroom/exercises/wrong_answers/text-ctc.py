# %% name="blanks removed first" origin="new" sentence="Leave the blanks out after the repeated characters, not before." must_say=["blank"] kind="value"
def decode(scores, characters):
    best = [i for i in scores.argmax(axis=1) if i != 0]
    text = ""
    for k in range(len(best)):
        if k == 0 or best[k] != best[k - 1]:
            text += characters[best[k]]
    return text

# %% name="before only set for letters" origin="new" sentence="Set before for each row, also for a blank." must_say=["blank"] kind="value"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmax(axis=1):
        if i != before and i != 0:
            text += characters[i]
            before = i
    return text

# %% name="repeats kept" origin="new" sentence="A letter over several columns is one letter." must_say=["one letter|run|one before|row before"] kind="value"
def decode(scores, characters):
    text = ""
    for i in scores.argmax(axis=1):
        if i != 0:
            text += characters[i]
    return text

# %% name="blanks kept" origin="new" sentence="Leave out the blanks: position 0." must_say=["blank"] kind="value"
def decode(scores, characters):
    text = ""
    before = -1
    for i in scores.argmax(axis=1):
        if i != before:
            text += characters[i]
        before = i
    return text

# %% name="all characters" origin="new" sentence="Take one of each run, and no blanks." must_say=["run|blank"] kind="value"
def decode(scores, characters):
    text = ""
    for i in scores.argmax(axis=1):
        text += characters[i]
    return text

# %% name="minus as the blank" origin="new" sentence="The blank is the first of the characters, whatever it is: compare the position with 0." must_say=["blank"] kind="value"
def decode(scores, characters):
    text = ""
    before = ""
    for i in scores.argmax(axis=1):
        if characters[i] != before and characters[i] != "-":
            text += characters[i]
        before = characters[i]
    return text

# %% name="axis 0" origin="new" sentence="The best character of each row: argmax(axis=1)." must_say=["axis"] kind="error"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmax(axis=0):
        if i != before and i != 0:
            text += characters[i]
        before = i
    return text

# %% name="no axis" origin="new" sentence="argmax without axis gives one number: use argmax(axis=1)." must_say=["axis|one number|iterate|loop"] kind="error"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmax():
        if i != before and i != 0:
            text += characters[i]
        before = i
    return text

# %% name="list" origin="new" sentence="Join the characters to a text." must_say=["text|join|str"] kind="type"
def decode(scores, characters):
    text = []
    before = 0
    for i in scores.argmax(axis=1):
        if i != before and i != 0:
            text.append(characters[i])
        before = i
    return text

# %% name="overwritten" origin="new" sentence="text = replaces the text; use text +=." must_say=["\\+=|one character"] kind="value"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmax(axis=1):
        if i != before and i != 0:
            text = characters[i]
        before = i
    return text

# %% name="return in the loop" origin="new" sentence="return stands inside the loop." must_say=["return"] kind="value"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmax(axis=1):
        if i != before and i != 0:
            text += characters[i]
            return text
        before = i

# %% name="break at a blank" origin="new" sentence="A blank does not end the text: use continue." must_say=["blank"] kind="value"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmax(axis=1):
        if i == 0 and text:
            break
        if i != before and i != 0:
            text += characters[i]
        before = i
    return text

# %% name="each once" origin="new" sentence="A letter can occur again later: compare only with the one before." must_say=["once|before"] kind="value"
def decode(scores, characters):
    text = ""
    for i in scores.argmax(axis=1):
        if i != 0 and characters[i] not in text:
            text += characters[i]
    return text

# %% name="minus 1" origin="new" sentence="characters[i] is right: position 0 is the blank, so nothing is subtracted." must_say=["moved by one|- 1|subtract"] kind="value"
def decode(scores, characters):
    text = ""
    before = 0
    for i in scores.argmax(axis=1):
        if i != before and i != 0:
            text += characters[i - 1]
        before = i
    return text
