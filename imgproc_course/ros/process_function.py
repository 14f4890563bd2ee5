"""Calls the function of an ImageProcessor, and turns what goes wrong in it into one line."""

import traceback
from pathlib import Path


class SkippedImageError(Exception):
    """An image could not be processed. The text gives the cause in one line; the node continues."""


def call_process(process, frame, parameters, outputs):
    """{output: array} of these outputs; a result that is a function is called only if it is one of them."""
    try:
        results = process(frame, **parameters)
        if isinstance(results, dict) and results.keys() >= set(outputs):
            values = {output: results[output] for output in outputs}
            return {output: value() if callable(value) else value for output, value in values.items()}
    except Exception as error:  # process is other people's code, and the node must live on
        raise SkippedImageError(f"process failed {_location(error, process)}") from error
    returned = list(results) if isinstance(results, dict) else f"a {type(results).__name__}"
    raise SkippedImageError(f"process must return a dict with the keys {outputs}, but it returned {returned}")


def _location(error, process):
    # The last line in the learner's own file helps more than a line deep in a library that it called.
    own_file = getattr(getattr(process, "__code__", None), "co_filename", None)
    frames = traceback.extract_tb(error.__traceback__)
    frame = next((frame for frame in reversed(frames) if frame.filename == own_file), frames[-1])
    text = traceback.format_exception_only(error)[-1].strip()
    return f"in line {frame.lineno} of {Path(frame.filename).name} ({frame.line}): {text}"
