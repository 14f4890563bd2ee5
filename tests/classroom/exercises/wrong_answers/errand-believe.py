# %% name="only KITCHEN" sentence="Count for each name, not for KITCHEN alone." must_say=["each name"] must_not_say=["equal|same number"] kind="value"
def believe(readings, names, votes):
    count = 0
    for look in readings:
        if any(edit_distance(text.upper(), "KITCHEN") <= 1 for text in look):
            count += 1
    return "KITCHEN" if count >= votes else None
