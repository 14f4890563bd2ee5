# %% name="0 and 255 instead of bool" origin="walk" sentence="You return 0 and 255, and the task asks for bool arrays: a comparison such as thinned > high is one already." must_say=["255|uint8|dtype", "bool|True"] must_not_say=["strictly above"] kind="dtype"
def double_threshold(thinned, low, high):
    strong = np.where(thinned > high, 255, 0).astype(np.uint8)
    weak = np.where((thinned > low) & (thinned <= high), 255, 0).astype(np.uint8)
    return weak, strong

# %% name="at least instead of above" origin="walk" sentence="You use >=, and the thresholds mean strictly above: write >." must_say=[">=|strict|at least|equal", "strict|above|write >|use >|not >="] must_not_say=["swap", "bool"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned >= high
    return (thinned >= low) & ~strong, strong

# %% name="results swapped" origin="walk" sentence="You return the strong mask first; the order is weak, strong: exchange the two." must_say=["strong|seeds", "weak|candidates", "first|swap|exchang|wrong way|other way"] must_not_say=["strictly"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & ~strong
    return strong, weak

# %% name="chained comparison" origin="new" sentence="low < thinned <= high does not work with an array: write two comparisons in parentheses with & between them." must_say=["chain|low < ?thinned|two comparisons|split|between the two", "&|logical_and"] kind="error"
def double_threshold(thinned, low, high):
    weak = low < thinned <= high
    strong = thinned > high
    return weak, strong

# %% name="and between arrays" origin="new" sentence="and needs single values; between two arrays of True and False write &." must_say=["\\band\\b", "&|logical_and", "single|array|ambiguous|needs"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = thinned > low and thinned <= high
    return weak, strong

# %% name="parentheses forgotten around &" origin="new" sentence="& is computed before > and <=, so put each comparison in parentheses." must_say=["parenthes|bracket", "&", "before|each|around|first|binds"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = thinned > low & thinned <= high
    return weak, strong

# %% name="hard-coded 50 and 150" origin="new" sentence="You compare with 50 and 150 instead of low and high: use the arguments, other calls have other thresholds." must_say=["\\b50\\b|\\b150\\b|hard|fixed|typed|constant", "\\blow\\b|\\bhigh\\b|argument|parameter"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > 150
    weak = (thinned > 50) & ~strong
    return weak, strong

# %% name="values instead of masks" origin="new" sentence="thinned[thinned > high] picks the values and loses their places: return the masks themselves." must_say=["picks|places|positions are|values and|select|lose|shape", "mask|bool|True|comparison"] kind="shape"
def double_threshold(thinned, low, high):
    strong = thinned[thinned > high]
    weak = thinned[(thinned > low) & (thinned <= high)]
    return weak, strong

# %% name="magnitudes kept" origin="new" sentence="You keep the magnitudes where a pixel is weak or strong; the task asks for True and False: return the comparisons." must_say=["magnitude|int32|keep", "bool|True|mask|comparison"] kind="dtype"
def double_threshold(thinned, low, high):
    strong = np.where(thinned > high, thinned, 0)
    weak = np.where((thinned > low) & (thinned <= high), thinned, 0)
    return weak, strong

# %% name="one image with three levels" origin="new" sentence="You return one array with the levels 0, 1 and 2; the task asks for two bool arrays, weak and strong." must_say=["one (array|image)|levels|0, 1", "two|both|pair"] kind="type"
def double_threshold(thinned, low, high):
    result = np.zeros(thinned.shape, np.uint8)
    result[thinned > low] = 1
    result[thinned > high] = 2
    return result

# %% name="positions instead of masks" origin="new" sentence="np.argwhere gives the positions of the pixels; the task asks for masks as large as the image: return the comparisons." must_say=["position|argwhere|coordinates|indices", "mask|bool|comparison|shape"] kind="shape"
def double_threshold(thinned, low, high):
    strong = np.argwhere(thinned > high)
    weak = np.argwhere((thinned > low) & (thinned <= high))
    return weak, strong

# %% name="weak below low or above" origin="new" sentence="The weak mask needs both conditions, above low and not above high: with | (or) nearly every pixel is weak." must_say=["\\||\\(or\\)|with or\\b|or instead|nearly every", "&|\\band\\b|both"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) | ~strong
    return weak, strong

# %% name="whole array in an if" origin="new" sentence="thinned > high is an array, and if needs one True or False: return the comparison itself instead of an if." must_say=["\\bif\\b", "array|many|ambiguous|one True"] kind="error"
def double_threshold(thinned, low, high):
    weak = np.zeros(thinned.shape, bool)
    strong = np.zeros(thinned.shape, bool)
    if thinned > high:
        strong = True
    elif thinned > low:
        weak = True
    return weak, strong

# %% name="low and high swapped" origin="new" sentence="You compare the strong mask with low and the weak one with high: it is the other way round." must_say=["\\blow\\b", "\\bhigh\\b", "other way|swap|exchang|wrong way|revers"] must_not_say=["dtype"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > low
    weak = (thinned > high) & ~strong
    return weak, strong

# %% name="thresholds divided by 4" origin="new" sentence="low and high are filter responses already, like thinned: do not divide them by 4." must_say=["\\b4\\b|divid", "thinned|already|unit|response|not"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > high / 4
    weak = (thinned > low / 4) & ~strong
    return weak, strong

# %% name="only the strong mask" origin="new" sentence="You return the strong mask alone; the task asks for both, weak and strong, in this order." must_say=["alone|only (the strong|one)|one (array|mask)|single (array|mask)", "both|two|weak|pair"] kind="type"
def double_threshold(thinned, low, high):
    return thinned > high

# %% name="printed" origin="new" sentence="You print the two masks and return nothing: use return." must_say=["return", "print"] kind="no-return"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & ~strong
    print(weak, strong)

# %% name="stages of another cell" origin="new" sentence="stages belongs to another cell and to the lesson's frame: compare thinned, the argument of your function." must_say=["\\bstages\\b", "cell|thinned|argument|parameter"] kind="other-cell"
def double_threshold(thinned, low, high):
    strong = stages.thinned > high
    weak = (stages.thinned > low) & ~strong
    return weak, strong

# %% name="minus between masks" origin="new" sentence="NumPy cannot subtract masks of True and False: write weak & ~strong." must_say=["subtract|minus", "~|\\^|logical"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) - strong
    return weak, strong

# %% name="not of a mask" origin="new" sentence="not takes a single True or False; for a mask write ~." must_say=["\\bnot\\b (takes|works|needs|is)|\\bnot\\b", "~|logical_not"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & (not strong)
    return weak, strong

# %% name="input changed" origin="new" sentence="You write into thinned, which belongs to the caller: compute the masks from comparisons and leave the input as it is." must_say=["write into|chang|overwrit|in place", "input|caller|thinned|argument"] kind="input-changed"
def double_threshold(thinned, low, high):
    strong = thinned > high
    thinned[strong] = 0
    weak = thinned > low
    return weak, strong

# %% name="not for ~" origin="walk" sentence="Python reads `not` only before a whole condition: between arrays write & ~strong." must_say=["~"] must_not_say=["order"] kind="syntax"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = thinned > low & not strong
    return weak, strong

# %% name="no parentheses" origin="walk" sentence="Python computes low & ~strong before the comparison: put thinned > low in parentheses." must_say=["parenthes"] must_not_say=["order of|swapped"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = thinned > low & ~strong
    return weak, strong

# %% name="loop over rows" origin="walk" sentence="The loop gives the values of the pixels, and strong[value] takes a value for a position: compare the whole array, thinned > high." must_say=["positions?|value for|whole array"] must_not_say=["Does the loop read"] kind="error"
def double_threshold(thinned, low, high):
    weak = np.zeros(thinned.shape, dtype=bool)
    strong = np.zeros(thinned.shape, dtype=bool)
    for row in thinned:
        for value in row:
            if value > high:
                strong[value] = True
            elif value > low:
                weak[value] = True
    return weak, strong

# %% name="strong minus weak" origin="walk" sentence="Masks cannot be subtracted: write above_low & ~strong." must_say=["~"] kind="error"
def double_threshold(thinned, low, high):
    above_low = thinned > low
    strong = thinned > high
    return above_low - strong, strong
