# %% name="names of the pages, not of the task" origin="walk" sentence="The name \"gray\" is not one of the four: return exactly \"grayscale\", \"binarization\", \"edges\" or \"noise removal\"." must_say=["\"?gr[ae]y\"?", "grayscale"] must_not_say=["capital"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "gray"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="binary instead of binarization" origin="walk" sentence="You return \"binary\", but the task's name for this operation is \"binarization\"." must_say=["\\bbinary\\b", "binarization"] must_not_say=["channel"] kind="value"
def name_operation(before, after):
    if len(after.shape) == 3:
        return "noise removal"
    values = len(np.unique(after))
    if values > 2:
        return "grayscale"
    elif (after == 255).mean() >= 0.25:
        return "binary"
    else:
        return "edges"

# %% name="third of the shape asked of a gray image" origin="walk" sentence="A gray image has only two numbers in its shape, so after.shape[2] does not exist: ask len(after.shape) or after.ndim first." must_say=["two|\\b2\\b|no third|dimension|tuple index", "shape|ndim"] kind="error"
def name_operation(before, after):
    if after.shape[2] == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="set of an array" origin="walk" sentence="set() cannot hold the rows of an array (an array is not hashable): np.unique(after) gives the different values." must_say=["set|hash", "unique|ravel|flat|tolist"] kind="error"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(set(after)) > 2:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="whole array in an if" origin="walk" sentence="after == 255 is one True or False for each pixel, and if needs a single one: ask with .any(), .all() or compare .mean() with a number." must_say=["array|each pixel|many|one for", "any|all|mean"] kind="error"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if after == 255:
        return "binarization"
    return "grayscale"

# %% name="edges and binarization swapped" origin="new" sentence="You have the two names the wrong way round: edges are thin, so few pixels are white; a binary image has large white areas." must_say=["swap|exchang|wrong way|other way|turned (a)?round|mixed up|reverse|below|less", "edge|thin|white|few"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if (after == 255).mean() > 0.2:
        return "edges"
    return "binarization"

# %% name="two values is always binarization" origin="new" sentence="Edges have only 0 and 255 too, so two values are not enough to say binarization: also look at the share of white pixels." must_say=["edge", "two values|\\b2\\b|also|too|not enough|0 and 255", "white|share|mean|how many"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) == 2:
        return "binarization"
    if len(np.unique(after)) < 2:
        return "edges"
    return "grayscale"

# %% name="noise removal asked by equality of values" origin="new" sentence="Noise removal changes pixels, so before and after are not equal; what stays is the shape with its three channels." must_say=["equal|same|chang|array_equal", "three|channel|colou?r"] kind="value"
def name_operation(before, after):
    if np.array_equal(before, after):
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="capital letter" origin="new" sentence="\"Grayscale\" with a capital letter is another text than \"grayscale\": write all names in small letters." must_say=["capital|upper|small letters|lower"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "Noise removal"
    if len(np.unique(after)) > 2:
        return "Grayscale"
    if (after == 255).mean() < 0.2:
        return "Edges"
    return "Binarization"

# %% name="share of white in percent" origin="new" sentence="The mean of a mask is a share between 0 and 1, and you compare it with 20: write 0.2, or multiply the share by 100." must_say=["percent|%|between 0 and 1|\\b20\\b", "0\\.2|100|20"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if (after == 255).mean() > 20:
        return "binarization"
    return "edges"

# %% name="mean of the gray levels instead of the mask" origin="new" sentence="after.mean() is the mean gray level from 0 to 255, not the share of white pixels: take the mean of the mask after == 255." must_say=["mean gray|gray level|0 to 255|not the share", "== ?255|mask|share|white"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if after.mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="white counted, not its share" origin="new" sentence="sum() gives the number of white pixels, not their share: divide by the number of pixels, or use mean()." must_say=["\\bsum\\b|count|number of white", "share|mean|divide"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    white = (after == 255).sum()
    if white < 0.2:
        return "edges"
    return "binarization"

# %% name="print instead of return" origin="new" sentence="The names are only printed, so the function gives None back: use return in place of print." must_say=["return", "print"] kind="no-return"
def name_operation(before, after):
    if after.ndim == 3:
        print("noise removal")
    elif len(np.unique(after)) > 2:
        print("grayscale")
    elif (after == 255).mean() < 0.2:
        print("edges")
    else:
        print("binarization")

# %% name="no answer for the last case" origin="new" sentence="For a binary image none of your ifs is true, so the function ends without return and gives None: add the last case." must_say=["None|no return|without (a )?return|nothing|last case|\\belse\\b|missing", "binar|last|case"] kind="no-return"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"

# %% name="looks at before" origin="new" sentence="You look at the image before the operation, and that is a colour image every time: look at after." must_say=["\\bbefore\\b", "look at after|image after|use after|\\bafter\\b", "look|colou?r|every time|instead|use"] kind="value"
def name_operation(before, after):
    if before.ndim == 3:
        return "noise removal"
    if len(np.unique(before)) > 2:
        return "grayscale"
    if (before == 255).mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="shape compared with 3" origin="new" sentence="after.shape is a tuple such as (720, 1280, 3) and never equals the number 3: compare len(after.shape) or after.ndim with 3." must_say=["tuple|never equal|number 3", "len|ndim|number of dimensions|last", "compar|equal|number 3|never"] kind="value"
def name_operation(before, after):
    if after.shape == 3:
        return "noise removal"
    elif len(np.unique(after)) > 2:
        return "grayscale"
    elif (after == 255).mean() < 0.2:
        return "edges"
    else:
        return "binarization"

# %% name="single = in the if" origin="new" sentence="Python cannot read this: = stores a value, and a comparison needs ==." must_say=["==", "stores|assign|syntax|Python cannot|needs =="] kind="syntax"
def name_operation(before, after):
    if after.ndim = 3:
        return "noise removal"
    return "grayscale"

# %% name="the size of the lesson's frame" origin="new" sentence="You compare with the size (720, 1280, 3) of the lesson's frame, but other images have other sizes: ask only for the number of dimensions." must_say=["lesson|hard|fixed|other sizes|other images|any size", "dimension|ndim|len|channel"] kind="value"
def name_operation(before, after):
    if after.shape == (720, 1280, 3):
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="gray is recognized by 246 values" origin="new" sentence="246 different values was the count for one frame of the lesson: a gray image is any with more than two values." must_say=["246|one (image|frame)|exact|lesson", "two|\\b2\\b"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) == 246:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="separate ifs, the later one wins" origin="new" sentence="Your ifs run one after the other, so a later one writes over the name of an earlier one: use elif, or return at once." must_say=["elif|return at once|return immediately|one after the other|last if|later", "over|elif|name|result"] kind="value"
def name_operation(before, after):
    name = "noise removal"
    if after.ndim == 2 and len(np.unique(after)) > 2:
        name = "grayscale"
    if (after == 255).mean() < 0.2:
        name = "edges"
    if (after == 255).mean() >= 0.25:
        name = "binarization"
    return name

# %% name="gray image asked for three channels with len" origin="new" sentence="len(after) is the number of rows, not of channels: use after.ndim or len(after.shape)." must_say=["\\blen\\b|number of rows", "row", "ndim|len\\(after\\.shape\\)|shape"] kind="value"
def name_operation(before, after):
    if len(after) == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="the image comes back, not its name" origin="new" sentence="You return the image after itself; the task asks for the name of the operation, as text." must_say=["return|back|came", "image|array", "name|text|string|\\bstr\\b", "text|string|\\bstr\\b|itself"] kind="type"
def name_operation(before, after):
    if after.ndim == 3:
        return after
    return "grayscale"

# %% name="edges below a tenth" origin="new" sentence="An edge image may have white on up to a fifth of its pixels, and you stop at a tenth: compare with 0.2." must_say=["0\\.2|fifth|20 ?%|quarter", "edge|white|share"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if (after == 255).mean() < 0.1:
        return "edges"
    return "binarization"

# %% name="binary only above a half" origin="new" sentence="A binary image may have white on only a quarter of its pixels, and you ask for a half: compare with 0.25 or 0.2." must_say=["0\\.2|quarter|25 ?%|fifth", "binar|white|share"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after)) > 2:
        return "grayscale"
    if (after == 255).mean() > 0.5:
        return "binarization"
    return "edges"

# %% name="gray recognized by a missing 255" origin="new" sentence="A gray image can have white pixels (255), too: count its different values instead, more than two means gray." must_say=["255|white", "different|two|unique|values"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if after.max() < 255:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"

# %% name="only the first row looked at" origin="new" sentence="after[0] is the first row only, and a gray image can have one or two values there: look at the whole array." must_say=["first row|after\\[0\\]|one row", "whole|all|entire|every"] kind="value"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if len(np.unique(after[0])) > 2:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"
