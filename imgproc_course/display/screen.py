"""The picture of a live view or a tuner: one image of a fixed size, and room for an error under it."""

import html
import linecache
import traceback
from pathlib import Path

import cv2
import ipywidgets as widgets
import numpy as np
from traitlets import Unicode

from imgproc_course.display.figures import check_picture, to_rgb

GAP = 6
WIDTH, WIDTH_OF_SEVERAL, HIGHEST = 640, 960, 480
QUALITY = 80
HERE = Path(__file__).parent


class NamedImage(widgets.Image):
    """An image whose tooltip a screen reader reads as its name.

    ipywidgets 8.1 shows a tooltip only on widgets that have a description, and fails on the others.
    """

    description = Unicode("").tag(sync=True)


class Screen:
    """Shows arrays in one ipywidgets image. A thread may call it: it only assigns to widgets that exist.

    Parameters
    ----------
    encoding : channel order of colour pictures
    width : CSS pixels; None: WIDTH for one picture, WIDTH_OF_SEVERAL for several side by side
    limits : (low, high) shown black and white, for gray pictures that are neither uint8 nor bool
    alt : what a screen reader says of the picture
    caption : a sentence under it, or None
    """

    def __init__(self, encoding, width, limits, alt, caption):
        self.encoding, self.limits, self._wanted_width = encoding, limits, width
        self._size = None
        whole = {"max_width": "100%", "margin": "2px"}
        self.image = NamedImage(
            format="jpeg", layout=widgets.Layout(object_fit="contain", **whole), tooltip=alt
        )
        self._titles = widgets.HTML(layout=widgets.Layout(**whole))
        # Its height never changes: an error that comes and goes must not move the page.
        self._message = widgets.HTML(layout=widgets.Layout(height="62px", overflow="auto", **whole))
        width = width or WIDTH
        self._resize(width, round(width * 9 / 16))
        self.image.value = _encode(np.full((self._size[1], width), 230, np.uint8))
        under = [widgets.HTML(html.escape(caption))] if caption else []
        self.box = widgets.VBox([self._titles, self.image, *under, self._message])

    def show(self, result):
        """Shows an array, or several in a list or dict (of title -> array). Returns the JPEG's bytes."""
        titles, pictures = self._read(result)
        jpeg = _encode(self._compose(pictures))
        self._set_titles(titles, pictures)
        self.image.value = jpeg
        return jpeg

    def say(self, words="", *, wrong=False):
        """A line under the picture; `wrong` makes it red."""
        colour = "color: var(--jp-error-color1, #b00020);" if wrong else ""
        text = f'<div style="{colour} line-height: 1.35; white-space: pre-wrap">{html.escape(words)}</div>'
        if text != self._message.value:
            self._message.value = text

    def _read(self, result):
        titles, arrays = _take_apart(result)
        pictures = []
        for k, (title, array) in enumerate(zip(titles, arrays, strict=True)):
            name = title or ("the result" if len(arrays) == 1 else f"result {k}")
            pictures.append(check_picture(array, self.encoding, title, name))
            self._check_scale(pictures[-1], name)
        return titles, pictures

    def _check_scale(self, picture, name):
        dtype = picture.array.dtype
        if picture.order == "gray" and dtype not in (np.uint8, np.bool_) and self.limits is None:
            raise ValueError(
                f"{name} has dtype {dtype}: say which values are black and white, "
                f"limits=({picture.array.min():g}, {picture.array.max():g}) perhaps, or return uint8"
            )

    def full_size(self, result):
        """(rows, cols) or (rows, cols, 3) uint8, blue first: what `show` shows, not made smaller."""
        _, pictures = self._read(result)
        return self._side_by_side(pictures, max(picture.array.shape[0] for picture in pictures))

    def _compose(self, pictures):
        width = self._wanted_width or (WIDTH if len(pictures) == 1 else WIDTH_OF_SEVERAL)
        room = width - GAP * (len(pictures) - 1)
        height = max(1, min(HIGHEST, round(room / sum(map(_aspect, pictures)))))
        self._resize(width, height)
        return self._side_by_side(pictures, height)

    def _side_by_side(self, pictures, height):
        parts = [
            self._fit(picture, (max(1, round(height * _aspect(picture))), height)) for picture in pictures
        ]
        if len(parts) == 1:
            return parts[0]
        gap = np.full((height, GAP, 3), 255, np.uint8)
        parts = [cv2.cvtColor(part, cv2.COLOR_GRAY2BGR) if part.ndim == 2 else part for part in parts]
        return np.hstack([piece for part in parts for piece in (part, gap)][:-1])

    def _fit(self, picture, size):
        array = picture.array
        if picture.order == "gray" and array.dtype == bool:
            array = array.view(np.uint8) * np.uint8(255)
        elif array.dtype != np.uint8:
            scaled = picture.order == "gray"
            array = to_rgb(picture, self.limits if scaled else (0, 1))[:, :, ::-1]
            picture = picture._replace(order="bgr")
        shrinks = size[0] < array.shape[1]
        array = cv2.resize(array, size, interpolation=cv2.INTER_AREA if shrinks else cv2.INTER_NEAREST)
        if picture.order in ("gray", "bgr"):
            return array
        return to_rgb(picture._replace(array=array), (0, 255))[:, :, ::-1]

    def _resize(self, width, height):
        if (width, height) != self._size:
            self._size = width, height
            self.image.layout.height = f"{height}px"
            for widget in (self.image, self._titles, self._message):
                widget.layout.width = f"{width}px"

    def _set_titles(self, titles, pictures):
        if not any(titles):
            text = ""
        else:
            cells = "".join(
                f'<div style="flex: {_aspect(picture):.4f}; text-align: center">{html.escape(title)}</div>'
                for title, picture in zip(titles, pictures, strict=True)
            )
            text = f'<div style="display: flex; gap: {GAP}px">{cells}</div>'
        if text != self._titles.value:
            self._titles.value = text


def _aspect(picture):
    return picture.array.shape[1] / picture.array.shape[0]


def _take_apart(result):
    if result is None:
        raise ValueError("the function returned None; end it with `return` and the array to show")
    if isinstance(result, dict):
        titles, arrays = [str(title) for title in result], list(result.values())
    elif isinstance(result, (list, tuple)):
        titles, arrays = [""] * len(result), list(result)
    else:
        titles, arrays = [""], [result]
    if not arrays:
        raise ValueError("the function returned no picture: an empty list or dict")
    return titles, arrays


def _encode(picture):
    return cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])[1].tobytes()


def describe_error(error, function):
    """Type and message of an error, and the learner's line that raised it, in at most three lines."""
    words = f"{type(error).__name__}: {error}".strip()
    if "readonly" in words:
        words += "\nThe frame shares the message's memory: draw on frame.copy()."
    calls = [call for call in traceback.extract_tb(error.__traceback__) if _is_learners(call.filename)]
    if not calls:
        return f"{words}\n(called as {_name(function)})"
    call = calls[-1]
    line = linecache.getline(call.filename, call.lineno).strip()
    return f"{words}\nin {call.name}, line {call.lineno}:  {line}"


def _is_learners(filename):
    path = Path(filename)
    return path.parent != HERE and "site-packages" not in path.parts and not filename.startswith("<frozen")


def _name(function):
    return getattr(function, "__name__", type(function).__name__)
