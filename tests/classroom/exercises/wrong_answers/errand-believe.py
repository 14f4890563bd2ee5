# %% name="name in look" origin="new" sentence="A text with one wrong character votes as well: use edit_distance." must_say=["edit_distance"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if name in look:
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="upper, but exact" origin="new" sentence="A text with one wrong character votes as well: use edit_distance." must_say=["edit_distance"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if name in [text.upper() for text in look]:
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="upper forgotten" origin="new" sentence="Small letters: use text.upper()." must_say=["upper"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text, name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="lower" origin="new" sentence="The names are in capital letters: text.upper(), not lower()." must_say=["upper"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.lower(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="distance two" origin="new" sentence="At most 1, not 2." must_say=["at most 1|<= 1"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) <= 2 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="distance less than two allowed in capitals only" origin="new" sentence="Small letters: use text.upper()." must_say=["upper|small"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text, name) < 2 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="distance exactly one" origin="new" sentence="A right text votes as well: <= 1." must_say=["<= 1"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) == 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="distance zero" origin="new" sentence="One wrong character is allowed: <= 1." must_say=["<= 1"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) < 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="all" origin="new" sentence="One text is enough: any, not all." must_say=["any"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if all(edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="texts counted" origin="new" sentence="One look votes at most once." must_say=["once"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            for text in look:
                if edit_distance(text.upper(), name) <= 1:
                    count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="flattened" origin="new" sentence="One look votes at most once." must_say=["once"] kind="value"
def believe(readings, names, votes):
    texts = [text.upper() for look in readings for text in look]
    counts = [sum(edit_distance(text, name) <= 1 for text in texts) for name in names]
    best = counts.index(max(counts))
    return names[best] if counts[best] >= votes else None

# %% name="first text" origin="new" sentence="The name may be any text of the look." must_say=["any"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if look and edit_distance(look[0].upper(), name) <= 1:
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="index error at an empty look" origin="new" sentence="A look can be empty." must_say=["empty|out of range"] kind="error"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if edit_distance(look[0].upper(), name) <= 1:
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="joined" origin="new" sentence="Compare each text for itself." must_say=["each text"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if edit_distance(' '.join(look).upper(), name) <= 1:
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="substring of the name" origin="new" sentence="A part of the name is not enough." must_say=["part"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(text.upper() in name for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="substring of the text" origin="new" sentence="One wrong character is allowed: use edit_distance." must_say=["edit_distance"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(name in text.upper() for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="zip" origin="new" sentence="Compare by edit_distance: a missing character moves the others." must_say=["edit_distance"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(len(text) == len(name) and sum(p != q for p, q in zip(text.upper(), name)) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="first with enough votes" origin="new" sentence="The most votes win, not the first with enough." must_say=["most"] kind="value"
def believe(readings, names, votes):
    for name in names:
        count = sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings)
        if count >= votes:
            return name
    return None

# %% name="stops early" origin="new" sentence="Count all looks before you decide." must_say=["all looks|most"] kind="value"
def believe(readings, names, votes):
    counts = dict.fromkeys(names, 0)
    for look in readings:
        for name in names:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                counts[name] += 1
                if counts[name] >= votes:
                    return name
    return None

# %% name="greater or equal" origin="new" sentence="Of equals, the first wins: use >." must_say=["first"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count >= most:
            best, most = name, count
    return best if most >= votes else None

# %% name="votes ignored" origin="new" sentence="Return None if the name has fewer than votes." must_say=["votes"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best

# %% name="strictly more" origin="new" sentence="At least: >=." must_say=[">=|at least"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most > votes else None

# %% name="equal to votes" origin="new" sentence="At least: >=, not ==." must_say=[">="] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most == votes else None

# %% name="newest looks" origin="new" sentence="Count all looks." must_say=["all"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings[-votes:]:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="break after a name" origin="new" sentence="A look can vote for several names." must_say=["several"] kind="value"
def believe(readings, names, votes):
    counts = dict.fromkeys(names, 0)
    for look in readings:
        for name in names:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                counts[name] += 1
                break
    best = max(names, key=lambda name: counts[name])
    return best if counts[best] >= votes else None

# %% name="the number" origin="new" sentence="Return the name, not the number of votes." must_say=["name"] kind="type"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return most if most >= votes else None

# %% name="the look's text" origin="new" sentence="Return the name, not the text as it was read." must_say=["name"] kind="value"
def believe(readings, names, votes):
    best, most, last = None, 0, None
    for name in names:
        near = [t for look in readings for t in look if edit_distance(t.upper(), name) <= 1]
        count = sum(any(edit_distance(t.upper(), name) <= 1 for t in look) for look in readings)
        if count > most:
            best, most, last = name, count, near[-1]
    return last if most >= votes else None

# %% name="empty text" origin="new" sentence="Return None, not an empty text." must_say=["None"] kind="type"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else ''

# %% name="return in the loop" origin="new" sentence="Look at all names before you return." must_say=["all|first|loop"] kind="value"
def believe(readings, names, votes):
    for name in names:
        count = sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings)
        if count >= votes:
            return name
        else:
            return None

# %% name="in a row" origin="new" sentence="Other looks may be between the votes." must_say=["reset|between|one after"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        row = 0
        for look in readings:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                row += 1
            else:
                row = 0
            if row > most:
                best, most = name, row
    return best if most >= votes else None

# %% name="the smallest distance of an empty look" origin="walk" sentence="A look can be empty: min of nothing is an error." must_say=["empty"] must_not_say=["last index"] kind="error"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        nearest = [min(edit_distance(text.upper(), name) for text in look) for look in readings]
        count = sum(distance <= 1 for distance in nearest)
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="only KITCHEN" origin="walk" sentence="Count for each name, not for KITCHEN alone." must_say=["each name"] must_not_say=["equal|same number"] kind="value"
def believe(readings, names, votes):
    count = 0
    for look in readings:
        if any(edit_distance(text.upper(), "KITCHEN") <= 1 for text in look):
            count += 1
    return "KITCHEN" if count >= votes else None

# %% name="the whole look" origin="walk" sentence="You compare the whole look, which is a list: compare each text." must_say=["whole look"] must_not_say=["You make the text small"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if edit_distance(look, name) <= 1:
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="name in text, or one wrong character" origin="walk" sentence="A longer text with the name in it does not vote." must_say=["longer text"] must_not_say=["two wrong"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    for name in names:
        count = 0
        for look in readings:
            if any(name in text.upper() or edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="the nearest name of each look" origin="walk" sentence="A look may vote for several names." must_say=["several"] kind="value"
def believe(readings, names, votes):
    counts = dict.fromkeys(names, 0)
    for look in readings:
        pairs = [(edit_distance(text.upper(), name), name) for name in names for text in look]
        if pairs:
            distance, name = min(pairs, key=lambda pair: pair[0])
            if distance <= 1:
                counts[name] += 1
    best = max(names, key=lambda name: counts[name])
    return best if counts[best] >= votes else None

# %% name="None in quotes" origin="walk" sentence="Return None without quotes." must_say=["quotes"] kind="type"
def believe(readings, names, votes):
    best, most = "None", 0
    for name in names:
        count = sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings)
        if count > most:
            best, most = name, count
    return best if most >= votes else "None"

# %% name="the count not set back" origin="walk" sentence="Set the count back to 0 for each name." must_say=["back to 0"] kind="value"
def believe(readings, names, votes):
    best, most = None, 0
    count = 0
    for name in names:
        for look in readings:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                count += 1
        if count > most:
            best, most = name, count
    return best if most >= votes else None

# %% name="the nearest text of each look" origin="walk" sentence="A look may vote for several names." must_say=["several"] kind="value"
def believe(readings, names, votes):
    counts = {name: 0 for name in names}
    for look in readings:
        best = None
        for text in look:
            for name in names:
                d = edit_distance(text.upper(), name)
                if d <= 1 and (best is None or d < best[0]):
                    best = (d, name)
        if best:
            counts[best[1]] += 1
    winner = max(counts, key=counts.get)
    return winner if counts[winner] >= votes else None

# %% name="break after a text" origin="walk" sentence="A look may vote for several names." must_say=["several"] kind="value"
def believe(readings, names, votes):
    counts = {name: 0 for name in names}
    for look in readings:
        for text in look:
            hit = [n for n in names if edit_distance(text.upper(), n) <= 1]
            if hit:
                counts[hit[0]] += 1
                break
    winner = max(counts, key=counts.get)
    return winner if counts[winner] >= votes else None

# %% name="two votes typed" origin="walk" sentence="Use the argument votes, not 2." must_say=["argument votes"] kind="value"
def believe(readings, names, votes):
    counts = {name: 0 for name in names}
    for look in readings:
        for name in names:
            if any(edit_distance(t.upper(), name) <= 1 for t in look):
                counts[name] += 1
    winner = max(counts, key=counts.get)
    return winner if counts[winner] >= 2 else None

# %% name="a Counter of sets" origin="walk" sentence="The first one in names wins, if the votes are equal: a Counter takes the one that it counted first." must_say=["first one in names"] must_not_say=[">="] kind="value"
def believe(readings, names, votes):
    counter = Counter()
    for look in readings:
        counter.update({name for name in names for text in look if edit_distance(text.upper(), name) <= 1})
    best = counter.most_common(1)
    return best[0][0] if best and best[0][1] >= votes else None

# %% name="a dict in the order of reading" origin="walk" sentence="The first one in names wins, if the votes are equal: a dict keeps the order in which you counted." must_say=["first one in names"] must_not_say=[">="] kind="value"
def believe(readings, names, votes):
    counts = {}
    for look in readings:
        for name in names:
            if any(edit_distance(text.upper(), name) <= 1 for text in look):
                counts[name] = counts.get(name, 0) + 1
    best = max(counts, key=counts.get, default=None)
    return best if best is not None and counts[best] >= votes else None

# %% name="sorted pairs" origin="walk" sentence="The first one in names wins, if the votes are equal, not the last of the alphabet." must_say=["first one in names", "alphabet|sort"] kind="value"
def believe(readings, names, votes):
    pairs = []
    for name in names:
        pairs.append((sum(any(edit_distance(text.upper(), name) <= 1 for text in look) for look in readings), name))
    most, best = sorted(pairs)[-1]
    return best if most >= votes else None
