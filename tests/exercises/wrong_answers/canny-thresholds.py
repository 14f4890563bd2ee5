# %% name="0 and 255 instead of bool" origin="walk" sentence="You return 0 and 255, and the task asks for bool arrays: a comparison such as thinned > high is one already." must_say=["255|uint8|dtype|int", "bool|True|comparison|mask"] must_not_say=["strictly above"] kind="dtype"
def double_threshold(thinned, low, high):
    strong = np.where(thinned > high, 255, 0).astype(np.uint8)
    weak = np.where((thinned > low) & (thinned <= high), 255, 0).astype(np.uint8)
    return weak, strong

# %% name="at least instead of above" origin="walk" sentence="You use >=, and the thresholds mean strictly above: write >." must_say=[">=|equal|strict|at least|above", ">|strict|above"] must_not_say=["swap", "bool"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned >= high
    return (thinned >= low) & ~strong, strong

# %% name="results swapped" origin="walk" sentence="You return the strong mask first; the order is weak, strong: exchange the two." must_say=["weak|candidates", "strong|seeds", "first|order|swap|exchang|wrong way"] must_not_say=["strictly"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & ~strong
    return strong, weak

# %% name="weak with the strong ones in it" origin="new" sentence="Your weak mask also holds the strong pixels: weak means above low and not above high, so no pixel may be in both." must_say=["weak", "both|also|not above high|disjoint|overlap|as well|strong"] must_not_say=["swap", "dtype"] kind="value"
def double_threshold(thinned, low, high):
    return thinned > low, thinned > high

# %% name="below low" origin="new" sentence="weak must be above low, and you take the pixels below it: turn the first comparison around." must_say=["low", "above|>|turn|below|revers"] must_not_say=["dtype", "bool"] kind="value"
def double_threshold(thinned, low, high):
    return thinned < low, thinned > high

# %% name="chained comparison" origin="new" sentence="low < thinned <= high does not work with an array: write two comparisons in parentheses with & between them." must_say=["chain|two comparisons|array|low <|separate", "&|logical_and"] kind="error"
def double_threshold(thinned, low, high):
    weak = low < thinned <= high
    strong = thinned > high
    return weak, strong

# %% name="and between arrays" origin="new" sentence="and needs single values; between two arrays of True and False write &." must_say=["\\band\\b|single|ambiguous", "&|logical_and"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = thinned > low and thinned <= high
    return weak, strong

# %% name="parentheses forgotten around &" origin="new" sentence="& is computed before > and <=, so put each comparison in parentheses." must_say=["parenthes|bracket", "&|comparison|before"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = thinned > low & thinned <= high
    return weak, strong

# %% name="hard-coded 50 and 150" origin="new" sentence="You compare with 50 and 150 instead of low and high: use the arguments, other calls have other thresholds." must_say=["50|150|hard|fixed|typed|constant", "low|high|argument|parameter"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > 150
    weak = (thinned > 50) & ~strong
    return weak, strong

# %% name="values instead of masks" origin="new" sentence="thinned[thinned > high] picks the values and loses their places: return the masks themselves." must_say=["values|places|position|shape|picks", "mask|bool|True|comparison"] kind="shape"
def double_threshold(thinned, low, high):
    strong = thinned[thinned > high]
    weak = thinned[(thinned > low) & (thinned <= high)]
    return weak, strong

# %% name="magnitudes kept" origin="new" sentence="You keep the magnitudes where a pixel is weak or strong; the task asks for True and False: return the comparisons." must_say=["magnitude|value|int", "bool|True|mask|comparison"] kind="dtype"
def double_threshold(thinned, low, high):
    strong = np.where(thinned > high, thinned, 0)
    weak = np.where((thinned > low) & (thinned <= high), thinned, 0)
    return weak, strong

# %% name="list of both" origin="new" sentence="You return a list with two arrays in it; return them with a comma, without square brackets (a tuple)." must_say=["list", "tuple|comma|bracket"] kind="type"
def double_threshold(thinned, low, high):
    strong = thinned > high
    return [(thinned > low) & ~strong, strong]

# %% name="one image with three levels" origin="new" sentence="You return one array with the levels 0, 1 and 2; the task asks for two bool arrays, weak and strong." must_say=["two|both|pair", "bool|weak|candidates|array|mask"] kind="type"
def double_threshold(thinned, low, high):
    result = np.zeros(thinned.shape, np.uint8)
    result[thinned > low] = 1
    result[thinned > high] = 2
    return result

# %% name="positions instead of masks" origin="new" sentence="np.argwhere gives the positions of the pixels; the task asks for masks as large as the image: return the comparisons." must_say=["position|argwhere|coordinates|indices|index", "mask|bool|comparison|shape"] kind="shape"
def double_threshold(thinned, low, high):
    strong = np.argwhere(thinned > high)
    weak = np.argwhere((thinned > low) & (thinned <= high))
    return weak, strong

# %% name="weak below low or above" origin="new" sentence="The weak mask needs both conditions, above low and not above high: with | (or) nearly every pixel is weak." must_say=["\\||\\bor\\b|both", "&|\\band\\b|both"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) | ~strong
    return weak, strong

# %% name="whole array in an if" origin="new" sentence="thinned > high is an array, and if needs one True or False: return the comparison itself instead of an if." must_say=["array|many values|ambiguous", "\\bif\\b|comparison|each"] kind="error"
def double_threshold(thinned, low, high):
    weak = np.zeros(thinned.shape, bool)
    strong = np.zeros(thinned.shape, bool)
    if thinned > high:
        strong = True
    elif thinned > low:
        weak = True
    return weak, strong

# %% name="low and high swapped" origin="new" sentence="You compare the strong mask with low and the weak one with high: it is the other way round." must_say=["low", "high", "other way|swap|exchang|wrong way|strong|revers"] must_not_say=["dtype"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > low
    weak = (thinned > high) & ~strong
    return weak, strong

# %% name="thresholds divided by 4" origin="new" sentence="low and high are filter responses already, like thinned: do not divide them by 4." must_say=["4|divid|unit|scal"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > high / 4
    weak = (thinned > low / 4) & ~strong
    return weak, strong

# %% name="only the strong mask" origin="new" sentence="You return the strong mask alone; the task asks for both, weak and strong, in this order." must_say=["both|two|weak|candidates"] kind="type"
def double_threshold(thinned, low, high):
    return thinned > high

# %% name="printed" origin="new" sentence="You print the two masks and return nothing: use return." must_say=["return", "print"] kind="no-return"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & ~strong
    print(weak, strong)

# %% name="stages of another cell" origin="new" sentence="stages belongs to another cell and to the lesson's frame: compare thinned, the argument of your function." must_say=["stages|another cell|other cell", "thinned|argument|parameter"] kind="other-cell"
def double_threshold(thinned, low, high):
    strong = stages.thinned > high
    weak = (stages.thinned > low) & ~strong
    return weak, strong

# %% name="minus between masks" origin="new" sentence="NumPy cannot subtract masks of True and False: write weak & ~strong." must_say=["subtract|minus|-", "&|~|\\^"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) - strong
    return weak, strong

# %% name="not of a mask" origin="new" sentence="not takes a single True or False; for a mask write ~." must_say=["\\bnot\\b", "~|logical_not"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & (not strong)
    return weak, strong

# %% name="input changed" origin="new" sentence="You write into thinned, which belongs to the caller: compute the masks from comparisons and leave the input as it is." must_say=["input|thinned|chang|overwrit", "copy|leave|comparison|new|not"] kind="input-changed"
def double_threshold(thinned, low, high):
    strong = thinned > high
    thinned[strong] = 0
    weak = thinned > low
    return weak, strong
