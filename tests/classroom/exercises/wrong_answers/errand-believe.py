# %% name="sorted pairs" sentence="The first one in names wins, if the votes are equal, not the last of the alphabet." must_say=["first one in names", "alphabet|sort"] kind="value"
def believe(readings, names, votes):
    pairs = []
    for name in names:
        pairs.append((sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings), name))
    most, best = sorted(pairs)[-1]
    return best if most >= votes else None

# %% name="None in quotes" sentence="Return None without quotes." must_say=["quotes"] kind="type"
def believe(readings, names, votes):
    best, most = "None", 0
    for name in names:
        count = sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings)
        if count > most:
            best, most = name, count
    return best if most >= votes else "None"

# %% name="the smallest distance of an empty look" sentence="A look can be empty: min of nothing is an error." must_say=["empty"] must_not_say=["last index"] kind="error"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        nearest = [min(edit_distance(text.upper(), name) for text in look) for look in readings]
        count = sum(distance <= 1 for distance in nearest)
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="only KITCHEN" sentence="Count for each name, not for KITCHEN alone." must_say=["each name"] must_not_say=["equal|same number"] kind="value"
def believe(readings, names, votes):
    count = 0
    for look in readings:
        if any(edit_distance(text.upper(), "KITCHEN") <= 1 for text in look):
            count += 1
    return "KITCHEN" if count >= votes else None

# %% name="two votes typed" sentence="Use the argument votes, not 2." must_say=["argument votes"] kind="value"
def believe(readings, names, votes):
    counts = {name: 0 for name in names}
    for look in readings:
        for name in names:
            if any(edit_distance(t.upper(), name) <= 1 for t in look):
                counts[name] += 1
    winner = max(counts, key=counts.get)
    return winner if counts[winner] >= 2 else None
