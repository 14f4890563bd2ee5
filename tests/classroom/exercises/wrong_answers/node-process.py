# %% name="gray level spelled as in prose" origin="walk" sentence="The key must be exactly \"gray\"; you spelled it \"grey\"." must_say=["grey", "gray"] must_not_say=["dtype", "list"] kind="value"
def process(frame):
    return {"grey": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}

# %% name="float64 value under the right key" origin="walk" sentence="The gray image has the dtype float64, and uint8 was asked for: round it and end with .astype(np.uint8)." must_say=["float|dtype", "uint8"] must_not_say=["key"] kind="dtype"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {"gray": gray * 1.0}

# %% name="to_gray without its import" origin="walk" sentence="to_gray is imported in another cell only: write its import line in this cell too, or call cv2.cvtColor." must_say=["to_gray", "import"] must_not_say=["define to_gray"] kind="missing-import"
def process(frame):
    return {"gray": to_gray(frame)}

# %% name="make_gray of the cell above" origin="new" sentence="make_gray is a function of another cell, which is not there when your answer is graded: write the line that computes gray in this cell." must_say=["make_gray", "cell"] kind="other-cell"
def process(frame):
    return make_gray(frame)

# %% name="array instead of a dictionary" origin="new" sentence="You return the gray image itself; the node needs a dictionary with the key \"gray\"." must_say=["dict", "gray|key"] kind="type"
def process(frame):
    return cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)

# %% name="a set instead of a dictionary" origin="new" sentence="Curly brackets without a key and a colon make a set, and an array cannot stand in a set: write {\"gray\": ...}." must_say=["set|hash", "key|colon|dict|\"gray\": ?"] kind="error"
def process(frame):
    return {cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}

# %% name="key without quotes" origin="new" sentence="Without quotes gray is the array, not the text \"gray\", and an array cannot be a key: put the key in quotes." must_say=["quot|text|string", "key"] kind="error"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {gray: gray}

# %% name="frame returned in three channels" origin="new" sentence="Your value still has three channels: the gray image has one number per pixel and the shape (height, width)." must_say=["three|\\b3\\b|channels", "one (number|value|channel)|height, width|shape|two dimensions"] kind="shape"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {"gray": cv2.cvtColor(gray, cv2.COLOR_GRAY2BGR)}

# %% name="frame changed in place" origin="new" sentence="frame *= ... and frame[...] = ... change the frame that others look at too: work on a copy, or store the result under a new name." must_say=["chang|overwrit|modif|in place|writes?", "copy|new (array|name|image)"] kind="input-changed"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    frame[..., 0] = gray
    frame[..., 1] = gray
    frame[..., 2] = gray
    return {"gray": frame[..., 0].copy()}

# %% name="more than one key" origin="new" sentence="The task asks for one key, \"gray\", and you also return \"frame\": leave the other key out." must_say=["one key|only|another key|extra|also|other key|second key", "key"] kind="value"
def process(frame):
    return {"frame": frame, "gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}

# %% name="dictionary printed" origin="new" sentence="You print the dictionary and return nothing: replace print by return." must_say=["return", "print"] kind="no-return"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    print({"gray": gray})

# %% name="sum wraps in uint8" origin="new" sentence="The sum of three uint8 channels runs past 255 and wraps around, and a plain average is not luma: use cv2.cvtColor, or widen and use the weights." must_say=["wrap|255|overflow|average", "luma|weigh|cvtColor|widen"] kind="value"
def process(frame):
    gray = (frame[..., 0] + frame[..., 1] + frame[..., 2]) // 3
    return {"gray": gray}

# %% name="luma truncated" origin="new" sentence="astype(np.uint8) cuts the fraction off instead of rounding: call np.round first, or better let cv2.cvtColor do it." must_say=["truncat|cuts?|fraction|drop", "np\\.round|\\bround(ing|ed)?\\b|cvtColor|half"] kind="value"
def process(frame):
    b, g, r = frame[..., 0], frame[..., 1], frame[..., 2]
    gray = 0.114 * b + 0.587 * g + 0.299 * r
    return {"gray": gray.astype(np.uint8)}

# %% name="file read in gray" origin="new" sentence="cv2.imread reads a file, and frame is an array already: cv2.cvtColor turns it gray." must_say=["imread|file", "array|cvtColor"] kind="error"
def process(frame):
    return {"gray": cv2.imread(frame, cv2.IMREAD_GRAYSCALE)}

# %% name="list of the dictionary" origin="new" sentence="You return a list with the dictionary in it: return the dictionary alone." must_say=["list", "dict"] kind="type"
def process(frame):
    return [{"gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}]

# %% name="capital key" origin="new" sentence="The key \"Gray\" has a capital letter, and the task asks for \"gray\": keys are compared letter by letter." must_say=["capital|upper|lower|small letter|letter by letter"] kind="value"
def process(frame):
    return {"Gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}

# %% name="gray image upside down" origin="new" sentence="You also turn the image upside down ([::-1] reverses the rows): that belongs to the practice below, here return the gray image as it is." must_say=["upside|revers|flip|::-1"] kind="value"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {"gray": gray[::-1]}

# %% name="list of values instead of an array" origin="new" sentence="tolist() makes a list of lists of the image, but the value must be an array: leave tolist() out." must_say=["list", "array"] kind="type"
def process(frame):
    return {"gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY).tolist()}

# %% name="parenthesis not closed" origin="new" sentence="Python cannot read this line: a parenthesis is opened and never closed." must_say=["parenthes|bracket|syntax", "closed|open|Python|missing|syntax|match"] kind="syntax"
def process(frame):
    return {"gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY}

# %% name="process of the shown frame only" origin="new" sentence="You read a frame of the recording yourself, so every call gives the same image: use the frame that the function receives." must_say=["recording|another frame|same (image|frame)", "argument|parameter|receiv|given"] kind="other-cell"
def process(frame):
    frame = open_recording("drive").frame(30)
    return {"gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}
