# %% name="sorted pairs" sentence="The first one in names wins, if the votes are equal, not the last of the alphabet." must_say=["first one in names", "alphabet|sort"] kind="value"
def believe(readings, names, votes):
    pairs = []
    for name in names:
        pairs.append((sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings), name))
    most, best = sorted(pairs)[-1]
    return best if most >= votes else None

# %% name="only KITCHEN" sentence="Count for each name, not for KITCHEN alone." must_say=["each name"] must_not_say=["equal|same number"] kind="value"
def believe(readings, names, votes):
    count = 0
    for look in readings:
        if any(edit_distance(text.upper(), "KITCHEN") <= 1 for text in look):
            count += 1
    return "KITCHEN" if count >= votes else None
