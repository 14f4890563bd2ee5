"""What is wrong with a node, in a sentence: from the records of two drives (see `node_driver`).

There is a sentence for each path of a record. The first path that differs counts.
"""

import re

import numpy as np

from imgproc_course.classroom.exercises.canonical import array_of
from imgproc_course.classroom.exercises.error_advice import read_phrases

# Errors of the driver, whose messages are sentences for a learner.
NODE_ERRORS = ("NodeError", "NotGradedError")
# The names in a record, those first that explain others.
_ORDER = (
    *("name", "missing elements", "build type", "names of pip", "missing dependencies", "packages"),
    *(
        "executables",
        "data files",
        "main",
        "sleeps",
        "windows",
        "node",
        "subscriptions",
        "publishers",
        "published early",
        "steps",
        "delivered",
    ),
    *("ended", "published", "log", "accepted", "topic", "type", "reliability", "durability", "history"),
    *("depth", "encoding", "height", "width", "pixels", "stamp", "frame_id"),
)


def sentence_on_node(expected, actual, arguments):
    """What differs between two records, given as canonical forms; "" if there is no sentence for it.

    `arguments` are those of the drive, look and steps.
    """
    differences = list(_differences(_plain(expected), _plain(actual)))
    # An error that the node logs for a right image explains why it published nothing.
    differences.sort(key=lambda difference: not (difference[0].endswith("/log") and difference[1] == ""))
    for path, wanted, given in differences:
        for pattern, sentence in _SENTENCES.items():
            match = re.fullmatch(pattern, path)
            if match:
                names = match.groupdict() | {"expected": wanted, "actual": given}
                steps = arguments[1][: int(names.get("step", -1)) + 1]
                text = sentence(wanted, given, steps) if callable(sentence) else sentence
                return text.format(**names)
    return ""


def advice_on_node_error(result):
    """What the error of a node's CallResult means, "" if nothing is certain."""
    text = f"{result.error}: {result.message}\n{result.line}"
    matches = ((re.match(pattern, text), advice) for pattern, advice in _ERRORS.items())
    return next((match.expand(advice) for match, advice in matches if match), "")


def differing_images(expected, actual, arguments):
    """(what was sent, expected, published) of the first image that differs, as arrays; or None."""
    for path, wanted, given in _differences(_plain(expected), _plain(actual)):
        match = re.fullmatch(f"{_IMAGE}/pixels", path)
        if match and isinstance(given, np.ndarray):
            return arguments[1][int(match["step"])]["image"], wanted, given
    return None


def _plain(form):
    """The value of a canonical form of plain values."""
    if form["type"] == "dict" and "items" in form:
        return {key.get("value"): _plain(value) for key, value in form["items"]}
    if form["type"] in ("list", "tuple") and "items" in form:
        return [_plain(item) for item in form["items"]]
    return array_of(form) if form["type"] == "ndarray" else form.get("value")


def _differences(expected, actual, path=""):
    """(path, expected, actual) of each place where two records differ; of the steps only of the first."""
    if isinstance(expected, dict) and isinstance(actual, dict) and expected.keys() == actual.keys():
        for name in sorted(expected, key=lambda name: _ORDER.index(name) if name in _ORDER else 99):
            yield from _differences(expected[name], actual[name], f"{path}/{name}")
    elif isinstance(expected, list) and isinstance(actual, list) and len(expected) == len(actual):
        for number, pair in enumerate(zip(expected, actual, strict=True)):
            differences = list(_differences(*pair, f"{path}/{number}"))
            yield from differences
            if differences and path == "/steps":
                return
    elif type(expected) is not type(actual) or not np.array_equal(expected, actual):
        yield path, expected, actual


def _on_endpoints(noun):
    def sentence(_wanted, given, _steps):
        if not given:
            return f"Your node has no {noun}: __init__ must call self.create_{noun}(...)."
        return f"Your node has more than one {noun}. The task asks for one."

    return sentence


def _on_reliability(_wanted, given, _steps):
    if given != "RELIABLE":
        return "The reliability of your subscription is {actual}. The task asks for {expected}."
    return (
        "The camera offers best effort: ROS does not connect a RELIABLE subscription, so no image arrives."
        " Write reliability=ReliabilityPolicy.BEST_EFFORT."
    )


def _on_log(wanted, given, _steps):
    if wanted != "error":
        return "Your node logs an error for an image that is right: {actual}"
    if given == "":
        return (
            "Your node skips the message that cannot be converted, but it logs nothing. In except, call"
            " self.get_logger().error(str(error))."
        )
    return "Your node logs the failure with the level {actual}. Use self.get_logger().error(...)."


_TRY = (
    " Put try: around the conversion, and below except CvBridgeError as error: log the error and return. Then"
    " the node goes on with the next image."
)


def _on_end(_wanted, given, _steps):
    if given == "UnboundLocalError":
        return (
            "After a message that cannot be converted, your callback goes on without a frame, and ends with"
            " UnboundLocalError. Write return at the end of except."
        )
    reason = " (a logger takes a text: str(error))" if given == "TypeError" else ""
    return "A message that cannot be converted ends your node with {actual}" + f"{reason}.{_TRY}"


def _on_published(wanted, given, _steps):
    if not wanted:
        return f"Your node publishes an image, although the message cannot be converted.{_TRY}"
    if not given:
        return "An image arrived, and your node published nothing. Does the callback call publish at its end?"
    return "Your node publishes more than one message for one image."


def _on_pixels(wanted, given, steps):
    if not isinstance(given, np.ndarray) or wanted.shape != given.shape:
        return "The data of the published image have another size than its height, width and encoding say."
    if _is_exchanged(given, steps[-1]):
        return (
            "Red and blue are exchanged: the channels of a frame are blue, green, red. Ask for bgr8, and"
            " convert with COLOR_BGR2GRAY."
        )
    text = f"{int((wanted != given).sum())} of {wanted.size} pixels of the published image are wrong."
    kinds = ["image" if "image" in step else "set" for step in steps if "get" not in step]
    if "set" in kinds[kinds.index("image") :]:  # the steps before were right
        return (
            f"{text} Before the parameters changed, they were right: does the callback read the new values?"
        )
    if not _is_of_edges(wanted):
        return text
    if _is_of_edges(given):
        when = " after they changed" if "set" in kinds else ""
        return f"{text} Compute the edges of the gray image itself, with the values of the parameters{when}."
    return "An image of edges has only the values 0 and 255. Yours has more: publish what cv2.Canny returns."


def _is_of_edges(image):
    return set(np.unique(image)) == {0, 255}


def _on_parameters(wanted, _given, _steps):
    first, value = next(iter(wanted.items()))
    names = ", ".join(wanted)
    return (
        f"Your node does not have the parameters {names}: __init__ declares each, as in"
        f' self.declare_parameter("{first}", {value!r}).'
    )


def _is_exchanged(gray, step):
    """Whether an image is gray with the weights of red and blue exchanged."""
    frame = step["image"]
    if frame.ndim != 3 or frame.shape[:2] != gray.shape:
        return False
    weights = (0.299, 0.587, 0.114) if step["encoding"] == "bgr8" else (0.114, 0.587, 0.299)
    return bool(np.abs(frame @ weights - gray).max() <= 1)


_STEP = r"/steps/(?P<step>\d+)"
_IMAGE = f"{_STEP}/published/0"
# {path: a sentence, or what makes one of the two values and of the steps up to this one}
_SENTENCES = {
    "/subscriptions": _on_endpoints("subscription"),
    "/publishers": _on_endpoints("publisher"),
    "/subscriptions/0/reliability": _on_reliability,
    f"{_STEP}/ended": _on_end,
    f"{_STEP}/published": _on_published,
    f"{_STEP}/log": _on_log,
    f"{_STEP}/parameters": _on_parameters,
    f"{_IMAGE}/pixels": _on_pixels,
} | read_phrases(
    r"""
/name
    The package is called {actual}. The task asks for {expected}.
/missing elements
    package.xml must have text in each of these elements: {actual}.
/build type
    The build type must be {expected}: <export><build_type>{expected}</build_type></export>.
/names of pip
    {actual} is a name of pip. package.xml has rosdep keys, such as python3-opencv.
/missing dependencies
    The node imports what package.xml does not name: {actual}. Write <exec_depend>...</exec_depend> for each.
/packages
    The argument packages of setup(...) must name the folder of the node, and nothing else.
/executables
    console_scripts makes these executables: {actual}. Write NAME = MODULE:FUNCTION. A module is named by its
    folder and its file, with a dot between them and without .py.
/data files
    data_files must install the marker and package.xml, each to its own folder: compare with a package that
    works. Yours installs {actual}.
/main
    The file of the node defines no function main, and the executable calls it.
/sleeps
    Your node sleeps. Meanwhile images wait, and those that do not fit into the queue are lost: a callback
    returns as soon as it can. Remove sleep.
/windows
    imshow and waitKey need a window on the computer on which the node runs. Remove them: a node publishes its
    images.
/node
    Your node is called {actual}. The task asks for {expected}: super().__init__("{expected}").
/subscriptions/0/topic
    You subscribe to {actual}, and the camera publishes {expected}.
/(subscriptions|publishers)/0/type
    The task asks for messages of the type {expected}, and yours are {actual}.
/subscriptions/0/durability
    The durability of your subscription is {actual}. The camera offers {expected}: write
    durability=DurabilityPolicy.{expected}.
/subscriptions/0/(?P<policy>depth|history)
    The {policy} of your subscription is {actual}. The task asks for {expected}.
/publishers/0/topic
    You publish on {actual}. The task asks for {expected}: write ~ for the name of the node.
/published early
    Your node publishes before an image has arrived. Publish in the callback only.
STEP/delivered
    The image did not reach your node: ROS connects none of its subscriptions with the camera. Repair step 1
    first.
STEP/parameters/(?P<name>\w+)
    The first value of the parameter {name} is {actual!r}. The task asks for {expected!r}:
    self.declare_parameter("{name}", {expected!r}).
STEP/accepted/(?P<name>\w+)
    Your node does not take a new value for the parameter {name}: it is not declared, or with another type
    (50.0 is no whole number), or a callback refuses it.
IMAGE/topic
    The image is published on {actual}. The task asks for {expected}.
IMAGE/encoding
    The message that you publish says {actual}. Pass the encoding {expected} to cv2_to_imgmsg.
IMAGE/(?P<side>height|width)
    The {side} of the published image is {actual}. Expected is {expected}.
IMAGE/(stamp/\d|frame_id)
    The image is right, but not its header: a receiver cannot know when and where it was taken. Copy the
    header: pass msg.header to cv2_to_imgmsg.
""".replace("STEP", _STEP).replace("IMAGE", _IMAGE)
)
# {an error as Python prints it, and the line that raised it: what it means}
_ERRORS = read_phrases(r"""
InvalidQoSProfileException
    QoSProfile needs a depth: QoSProfile(depth=5, ...).
TypeError: .*?(\w+)\(\) missing 1 required positional argument.*\n.*self\.\1\(\)
    You call \1 here. Pass the method itself, without parentheses: self.\1.
RuntimeError: .*callback should be
    ROS calls the callback with the message: def image_callback(self, msg):
AttributeError: .*_TYPE_SUPPORT
    The first argument of create_publisher and create_subscription is the class of the messages: Image.
InvalidTopicNameException
    A topic name has letters, digits, _ and /, such as ~/gray.
Parameter(?:NotDeclared|Uninitialized)Exception: .*?(\w+)\W*\n
    Declare the parameter \1 in __init__, with its first value: self.declare_parameter("\1", ...).
AttributeError: '(\w+)' object has no attribute '(\w+)'\n.*self\.\2
    The node has no \2. An attribute is made in __init__, as self.\2 = ...; a method stands in the class, as
    far to the right as __init__.
(?s:error: .*can not be treated as a double)
    This argument must be a number: self.get_parameter("low").value, of a parameter that is declared with a
    number (50, not "50").
TypeError: Expected .*, got .*ndarray
    publish takes a message, and this is an array: convert it with cv2_to_imgmsg first.
""")
