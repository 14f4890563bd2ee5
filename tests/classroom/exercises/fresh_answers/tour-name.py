# %% name="edges before binarization" origin="fresh" sentence="Your first test is true for binary images too: an edge image has few white pixels, less than a fifth." must_say=["white|share|fifth|quarter|binar"] must_not_say=["ndim"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) <= 2:
        return "edges"
    return "grayscale"

# %% name="noise_removal with underscore" origin="fresh" sentence="The text must be exactly \"noise removal\", with a space." must_say=["exactly|space|spell|underscore"] must_not_say=["ndim"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise_removal"
    white = (after == 255).mean()
    if len(np.unique(after)) > 2:
        return "grayscale"
    if white > 0.2:
        return "binarization"
    return "edges"

# %% name="wrong side of the share" origin="fresh" sentence="You have exchanged edges and binarization: edge images have few white pixels, binary images many." must_say=["exchang|swap|other way|few|less|more|binar|opposite"] must_not_say=["ndim"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    white = (after == 255).mean()
    if white > 0.2:
        return "edges"
    return "binarization"

# %% name="counts values of before" origin="fresh" sentence="You look at before; the operation shows in the values of after." must_say=["before|after"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    values = np.unique(before)
    if len(values) > 2:
        return "grayscale"
    if (after == 255).mean() > 0.2:
        return "binarization"
    return "edges"

# %% name="white counted as a number of pixels" origin="fresh" sentence="You compare the number of white pixels with 0.25: divide it by the number of pixels, or use mean." must_say=["share|mean|divide|number of|count|sum|size"] must_not_say=["ndim"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    white = (after == 255).sum()
    if white >= 0.25:
        return "binarization"
    return "edges"
