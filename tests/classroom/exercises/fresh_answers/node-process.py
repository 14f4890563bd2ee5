# %% name="array without a dictionary" origin="fresh" sentence="Return a dictionary with the key \"gray\", not the array." must_say=["dict|key"] kind="type"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return gray

# %% name="three channels again" origin="fresh" sentence="The value must have the shape (height, width): do not convert back to three channels." must_say=["shape|three channels|3 channels|\\(height, width\\)|one channel|GRAY2BGR|back"] must_not_say=["key"] kind="shape"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    gray = cv2.cvtColor(gray, cv2.COLOR_GRAY2BGR)
    return {"gray": gray}

# %% name="set instead of dictionary" origin="fresh" sentence="Braces with a comma make a set; a dictionary has a colon between key and value: {\"gray\": gray}." must_say=["colon|set|dict|:"] kind="error"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {"gray", gray}

# %% name="to_gray without import" origin="fresh" sentence="to_gray is not imported in this cell: write from imgproc_course.imaging import to_gray." must_say=["import"] kind="missing-import"
def process(frame):
    return {"gray": to_gray(frame)}

# %% name="paints on the frame" origin="fresh" sentence="You write into the given frame: work on a copy." must_say=["copy|given|chang"] kind="input-changed"
def process(frame):
    frame[..., 0] = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {"gray": frame[..., 0]}

# %% name="cvtcolor" origin="fresh" sentence="The function is called cvtColor, with a large C." must_say=["cvtColor"] kind="error"
def process(frame):
    gray = cv2.cvtcolor(frame, cv2.COLOR_BGR2GRAY)
    return {"gray": gray}

# %% name="COLOR_BGR2GREY" origin="fresh" sentence="The constant is called COLOR_BGR2GRAY." must_say=["COLOR_BGR2GRAY"] kind="error"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GREY)
    return {"gray": gray}

# %% name="RGB2GRAY" origin="fresh" sentence="The frame is BGR: use COLOR_BGR2GRAY." must_say=["BGR"] kind="value"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY)
    return {"gray": gray}

# %% name="print the dict" origin="fresh" sentence="print shows the dict; the node needs it returned." must_say=["return"] kind="no-return"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    print({"gray": gray})

# %% name="array alone" origin="fresh" sentence="The task asks for a dictionary, {\"gray\": gray}." must_say=["dict"] kind="type"
def process(frame):
    return cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)

# %% name="a set" origin="fresh" sentence="Curly brackets without a key make a set: write {\"gray\": gray}." must_say=["key|set"] kind="error"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {gray}

# %% name="key without quotes" origin="fresh" sentence="The key is a text, in quotes: \"gray\"." must_say=["quotes"] kind="error"
def process(frame):
    image = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {gray: image}

# %% name="key grey" origin="fresh" sentence="The key must be \"gray\"." must_say=["gray"] kind="value"
def process(frame):
    return {"Gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}

# %% name="cv2 misspelled" origin="fresh" sentence="The module is called cv2." must_say=["cv2"] kind="error"
def process(frame):
    gray = cv.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {"gray": gray}

# %% name="mean" origin="fresh" sentence="The mean is not the luma: each channel has a weight of its own." must_say=["luma|weight|cvtColor"] kind="value"
def process(frame):
    return {"gray": frame.mean(axis=2).astype(np.uint8)}
