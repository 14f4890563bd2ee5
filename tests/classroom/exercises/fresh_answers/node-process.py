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
