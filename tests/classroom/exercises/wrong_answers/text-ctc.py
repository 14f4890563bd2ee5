# %% name="all characters" sentence="Take one of each run, and no blanks." must_say=["run|blank"] kind="value"
def decode(scores, characters):
    text = ""
    for i in scores.argmax(axis=1):
        text += characters[i]
    return text

# %% name="list" sentence="Join the characters to a text." must_say=["text|join|str"] kind="type"
def decode(scores, characters):
    text = []
    before = 0
    for i in scores.argmax(axis=1):
        if i != before and i != 0:
            text.append(characters[i])
        before = i
    return text

# %% name="blanks removed first" sentence="Leave the blanks out after the repeated characters, not before." must_say=["blank"] kind="value"
def decode(scores, characters):
    best = [i for i in scores.argmax(axis=1) if i != 0]
    text = ""
    for k in range(len(best)):
        if k == 0 or best[k] != best[k - 1]:
            text += characters[best[k]]
    return text
