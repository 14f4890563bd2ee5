"""What is wrong with a node, in a sentence: from two records (see `feed`).

There is a sentence for each path of a record. The first path that differs counts.
"""

import re
from pathlib import Path

import numpy as np

from nbclassroom.exercises.canonical import array_of
from nbclassroom.exercises.error_advice import read_phrases

# Errors of `feed`, whose messages are sentences for a learner.
NODE_ERRORS = ("NodeError", "NotGradedError")
# The names in a record, those first that explain others.
_ORDER = (
    *("name", "missing elements", "build type", "names of pip", "missing dependencies", "executables"),
    *("missing paths", "packages", "data files", "main", "sleeps", "windows", "node", "subscriptions"),
    *("publishers", "published early", "steps", "delivered", "ended", "published", "log", "accepted"),
    *("topic", "type", "reliability", "durability", "history", "depth", "encoding", "height", "width"),
    *("pixels", "stamp", "frame_id"),
)


def sentence_on_node(expected, actual, arguments):
    """What differs between two records, as forms, of one feed(part, steps); "" if no sentence says it."""
    records = _plain(expected), _plain(actual)
    differences = list(_differences(*records))
    # An error that the node logs for a right image explains why it published nothing.
    differences.sort(key=lambda difference: not (difference[0].endswith("/log") and difference[1] == ""))
    for path, wanted, given in differences:
        for pattern, sentence in (_RULES | _PHRASES).items():
            place = f"{path}: {given!r}, not {wanted!r}"
            match = re.fullmatch(f"{pattern}([:,] .*)?", place, re.DOTALL)
            if match:
                names = match.groupdict() | {"expected": wanted, "actual": given, "advice": _ADVICE}
                steps = arguments[1][: int(names.get("step", -1)) + 1]
                text = sentence(wanted, given, steps) if callable(sentence) else sentence
                return text.format(**names) + (_ALWAYS_STANDS if _always_stands(*records, path) else "")
    return ""


def advice_on_node_error(result):
    """What the error of a node's CallResult means, "" if nothing is certain."""
    text = f"{result.error}: {result.message}\n{result.line}"
    matches = ((re.match(pattern, text), advice) for pattern, advice in _PHRASES.items())
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


def _on_pixels(wanted, given, steps):
    if not isinstance(given, np.ndarray) or wanted.shape != given.shape:
        return "The data of the published image have another size than its height, width and encoding say."
    if _is_exchanged(given, steps[-1]):
        return _PHRASES["<red and blue>"]
    text = f"{int((wanted != given).sum())} of {wanted.size} pixels of the published image are wrong."
    kinds = ["image" if "image" in step else "set" for step in steps if "get" not in step]
    if "set" in kinds[kinds.index("image") :]:  # the steps before were right
        question = "does the callback read the new values?"
        return f"{text} Before the parameters changed, they were right: {question}"
    if not _is_of_edges(wanted):
        return text
    if _is_of_edges(given):
        return f"{text} Compute the edges of the gray image itself, with the values of the parameters."
    levels = np.unique(given)
    own = " and ".join(map(str, levels)) if len(levels) < 3 else f"{len(levels)} different ones"
    text = f"An image of edges has only the values 0 and 255, yours has {own}"
    return f"{text}: publish what cv2.Canny returns."


def _on_speed(wanted, given, steps):
    step = steps[-1]
    when = "this message comes" if "topic" in step else f"no message came for {step.get('seconds')} s"
    when = step.get("about", when)
    if "topic" in step and "topic" not in steps[-2:][0]:
        when += f" and is the first one after {steps[-2]['seconds']} s without any"
    must = f"drive with {wanted} m/s" if wanted else "stand"
    says = f"says {given:.3g} m/s" + " (or there was none after this message)" * (not given)
    return f"When {when}, the robot must {must}, and the newest command of your node {says}."


def _always_stands(expected, actual, path):
    """Whether a node that drove stands, rightly, and never drives again in steps in which it should."""
    records = (expected, actual) if path.endswith(_SPEED) else ()
    published = [[step["published"] for step in record["steps"]] for record in records]
    if not published or any(len(messages) != 1 for steps in published for messages in steps):
        return False
    wanted, given = (
        np.array([message["fields"]["linear"]["x"] for (message,) in steps]) for steps in published
    )
    stops = np.flatnonzero((wanted == 0) & (given == 0))
    first = stops[0] if len(stops) else 0
    return bool(given[:first].any() and wanted[first:].any() and not given[first:].any())


def _is_of_edges(image):
    return set(np.unique(image)) == {0, 255}


def _is_exchanged(gray, step):
    """Whether an image is gray with the weights of red and blue exchanged."""
    frame = step["image"]
    if frame.ndim != 3 or frame.shape[:2] != gray.shape:
        return False
    weights = (0.299, 0.587, 0.114) if step["encoding"] == "bgr8" else (0.114, 0.587, 0.299)
    return bool(np.abs(frame @ weights - gray).max() <= 1)


_STEP = r"/steps/(?P<step>\d+)"
_IMAGE = f"{_STEP}/published/0"
# A path in a record, perhaps with its values ("/path: given, not expected"), and below it a sentence; and an
# error as Python prints it, with the line that raised it, and below it what the error means.
_TEXT = Path(__file__).with_suffix(".txt").read_text(encoding="utf-8")
_PHRASES = read_phrases(_TEXT.replace("STEP", _STEP).replace("IMAGE", _IMAGE))
_ADVICE = _PHRASES["<advice>"]
# What makes a sentence of the two values and of the steps up to this one
_SPEED = "/fields/linear/x"
_RULES = {f"{_IMAGE}/pixels": _on_pixels, f"{_IMAGE}{_SPEED}": _on_speed}
_ALWAYS_STANDS = (
    " After a stop it never drives again: does each scan set the speed, and reset the same timer?"
)
