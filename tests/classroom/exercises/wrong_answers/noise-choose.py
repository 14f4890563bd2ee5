# %% name="my_psnr of the cell above" origin="walk" sentence="my_psnr is defined in another cell: copy it into this cell, or import psnr from imgproc_course.imaging." must_say=["my_psnr", "cell|import"] kind="other-cell"
def best_filter(clean, noisy, filters):
    return max(filters, key=lambda name: my_psnr(clean, filters[name](noisy)))

# %% name="the smallest PSNR" origin="new" sentence="You keep the smallest PSNR, and a higher PSNR is cleaner: use max (or > in the loop)." must_say=["PSNR", "smallest|lowest|\\bmin\\b|wrong (way|direction)|worst", "\\bmax\\b|high|larg|>|great"] kind="value"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    return min(filters, key=lambda name: psnr(clean, filters[name](noisy)))

# %% name="the value instead of the name" origin="new" sentence="You return the highest PSNR; the task asks for the name of the filter that has it." must_say=["highest PSNR|the PSNR|value|score", "\\bname of|\\bname\\b", "You return the (highest|PSNR|value)|not the (value|PSNR|number)|asks"] kind="type"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    return max(psnr(clean, f(noisy)) for f in filters.values())

# %% name="the function instead of its name" origin="new" sentence="You return the function itself (a value of the dictionary); return its key, the name." must_say=["function", "\\bname\\b|\\bkey\\b", "return|itself"] kind="type"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    return max(filters.values(), key=lambda f: psnr(clean, f(noisy)))

# %% name="always median" origin="new" sentence="The median wins against salt and pepper only, and here the name is typed in: apply each filter and compare the PSNR." must_say=["median|typed|hard|fixed|always", "PSNR|each|compare|every"] kind="value"
def best_filter(clean, noisy, filters):
    return "median 3"

# %% name="filters applied to the clean image" origin="new" sentence="You filter the clean image, but the noisy one is to be cleaned: call each filter with noisy." must_say=["filter", "\\bclean\\b", "call each filter with noisy|filters?\\b.*noisy|noisy .*cleaned|apply .*noisy|\\(noisy\\)"] must_not_say=["compare with noisy"] kind="value"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    return max(filters, key=lambda name: psnr(clean, filters[name](clean)))

# %% name="compared with noisy" origin="new" sentence="You measure against the noisy image, so the filter that changes least wins: compare the result with clean." must_say=["against the noisy|with noisy|with the noisy|noisy", "compare .*clean|against clean|with clean|clean", "measure|compare|against|PSNR"] kind="value"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    return max(filters, key=lambda name: psnr(noisy, filters[name](noisy)))

# %% name="filter not called" origin="new" sentence="filters[name] is the function, not its result: call it with noisy, filters[name](noisy)." must_say=["call|\\(noisy\\)|parenthes", "function|result|\\(noisy\\)"] kind="error"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    scores = {}
    for name, f in filters.items():
        scores[name] = psnr(clean, f)
    return max(scores, key=scores.get)

# %% name="loop over the dictionary as pairs" origin="new" sentence="A loop over a dictionary gives its keys only: write filters.items() to get names and functions." must_say=["items\\(|\\.items", "dict|items|filters|function"] kind="error"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    best_name, best_value = None, -1
    for name, f in filters:
        value = psnr(clean, f(noisy))
        if value > best_value:
            best_name, best_value = name, value
    return best_name

# %% name="the best value is never updated" origin="new" sentence="You update the name but not the best value, so each filter is compared with the start value and the last one wins: store the new best value too." must_say=["updat|store|remember|not the best value|best_value|assign", "value|last|best"] kind="value"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    best_name, best_value = None, 0
    for name, f in filters.items():
        value = psnr(clean, f(noisy))
        if value > best_value:
            best_name = name
    return best_name

# %% name="return in the loop" origin="new" sentence="The return stands inside the loop, so only the first filter is tried: move it to the left, below the loop." must_say=["return", "loop|first filter|indent"] kind="value"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    best_name, best_value = None, 0
    for name, f in filters.items():
        value = psnr(clean, f(noisy))
        if value > best_value:
            best_name, best_value = name, value
        return best_name

# %% name="PSNR in uint8" origin="new" sentence="clean - result wraps around in uint8, so your PSNR is wrong: widen clean with astype(float) before you subtract." must_say=["wrap|uint8|overflow", "widen|astype|float"] kind="value"
def best_filter(clean, noisy, filters):
    scores = {}
    for name, f in filters.items():
        mse = ((clean - f(noisy)) ** 2).mean()
        scores[name] = 10 * np.log10(255**2 / mse)
    return max(scores, key=scores.get)

# %% name="largest MSE" origin="new" sentence="A large mean squared error is bad: with the MSE take the smallest, with PSNR the largest." must_say=["MSE|squared error", "small|\\bmin\\b|low"] kind="value"
def best_filter(clean, noisy, filters):
    errors = {}
    for name, f in filters.items():
        errors[name] = ((clean.astype(float) - f(noisy)) ** 2).mean()
    return max(errors, key=errors.get)

# %% name="a ranking instead of one name" origin="new" sentence="You return the whole sorted list of names: the task asks for one name, the best." must_say=["\\blist of|ranking|whole sorted|several names|all names", "one name|single|first|best|\\[0\\]"] kind="type"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    return sorted(filters, key=lambda name: psnr(clean, filters[name](noisy)), reverse=True)

# %% name="sorted upwards, first taken" origin="new" sentence="sorted() puts the smallest PSNR first, so [0] is the worst filter: take the last one, [-1], or sort with reverse=True." must_say=["sorted|order|\\[0\\]|first", "last|-1|reverse|max|highest", "smallest|ascend|upward|worst|lowest|up"] kind="value"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    return sorted(filters, key=lambda name: psnr(clean, filters[name](noisy)))[0]

# %% name="print instead of return" origin="new" sentence="You print the best name and return nothing: use return." must_say=["return", "print"] kind="no-return"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    print(max(filters, key=lambda name: psnr(clean, filters[name](noisy))))

# %% name="index of argmax" origin="new" sentence="np.argmax gives the position of the best score, a number: look the name up with list(filters)[position]." must_say=["position|index|argmax", "\\bname\\b"] kind="type"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    return np.argmax([psnr(clean, f(noisy)) for f in filters.values()])

# %% name="global filters of the lesson" origin="new" sentence="You use the four filters of the lesson by name, but the function gets its own dictionary: loop over filters." must_say=["lesson|typed|fixed|hard|KeyError|box 3", "filters|dict|loop"] kind="error"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    best = "box 3"
    for name in ["box 3", "Gaussian 1.5", "median 3", "bilateral"]:
        if psnr(clean, filters[name](noisy)) > psnr(clean, filters[best](noisy)):
            best = name
    return best

# %% name="two names of filters shadowed" origin="new" sentence="for filters in filters writes over the dictionary with a name, so filters[...] then indexes a text: give the loop variable another name." must_say=["overwrit|writes over|shadow|another name|loop variable|same name", "filters|dict"] kind="error"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    scores = {}
    for filters in filters:
        scores[filters] = psnr(clean, filters[filters](noisy))
    return max(scores, key=scores.get)

# %% name="the last filter above 30 dB" origin="new" sentence="You take the last filter that is better than 30 dB, a fixed number: keep the one with the highest PSNR of all." must_say=["30|fixed|last", "highest|best|max|larg"] kind="value"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    best = None
    for name, f in filters.items():
        if psnr(clean, f(noisy)) > 30:
            best = name
    return best
