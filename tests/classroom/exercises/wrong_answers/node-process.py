# %% name="gray level spelled as in prose" sentence="The key must be exactly \"gray\"; you spelled it \"grey\"." must_say=["grey", "gray"] must_not_say=["dtype", "list"] kind="value"
def process(frame):
    return {"grey": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}

# %% name="float64 value under the right key" sentence="The gray image has the dtype float64, and uint8 was asked for: round it and end with .astype(np.uint8)." must_say=["float|dtype", "uint8"] must_not_say=["key"] kind="dtype"
def process(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {"gray": gray * 1.0}

# %% name="array instead of a dictionary" sentence="You return the gray image itself; the node needs a dictionary with the key \"gray\"." must_say=["dict", "gray|key"] kind="type"
def process(frame):
    return cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)

# %% name="a set instead of a dictionary" sentence="Curly brackets without a key and a colon make a set, and an array cannot stand in a set: write {\"gray\": ...}." must_say=["set|hash", "key|colon|dict|\"gray\": ?"] kind="error"
def process(frame):
    return {cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}
