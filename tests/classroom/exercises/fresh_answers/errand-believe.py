# %% name="exact words" origin="fresh" sentence="A look also votes if one character is wrong: compare with edit_distance." must_say=["distance|one character|wrong"] kind="value"
def believe(readings, names, votes):
    for name in names:
        if sum(name in [text.upper() for text in look] for look in readings) >= votes:
            return name
    return None

# %% name="each text votes" origin="fresh" sentence="One look votes at most once for a name." must_say=["once"] kind="value"
def believe(readings, names, votes):
    counts = [sum(edit_distance(text.upper(), name) <= 1 for look in readings for text in look) for name in names]
    best = max(counts)
    return names[counts.index(best)] if best >= votes else None

# %% name="the first with enough" origin="fresh" sentence="Take the name with the most votes, not the first that has enough." must_say=["most"] kind="value"
def believe(readings, names, votes):
    for name in names:
        if sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings) >= votes:
            return name
    return None

# %% name="in a row" origin="fresh" sentence="The votes need not come from looks one after the other: count all of them." must_say=["all|one after the other|row"] kind="value"
def believe(readings, names, votes):
    for name in names:
        row = 0
        for look in readings:
            row = row + 1 if any(edit_distance(text.upper(), name) <= 1 for text in look) else 0
            if row >= votes:
                return name
    return None

# %% name="the number too" origin="fresh" sentence="Return the name alone, without its votes." must_say=["name"] kind="type"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings)
        if count > most:
            best, most = name, count
    return (best, most) if most >= votes else None

# %% name="votes too strict" origin="fresh" sentence="count may equal votes: >= and not >." must_say=["at least|>="] must_not_say=["last else"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings)
        if count > most:
            best, most = name, count
    return best if most > votes else None

# %% name="exact comparison" origin="fresh" sentence="A text with one wrong letter counts, too: edit_distance <= 1." must_say=["edit_distance"] must_not_say=["last else"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = sum(any(text.upper() == name for text in look) for look in readings)
        if count > most:
            best, most = name, count
    return best if most >= votes else None
