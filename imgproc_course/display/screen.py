"""The screen of a live view or a tuner: an image of fixed size, with a line for errors below it."""

import html
from typing import Any, NamedTuple

import cv2
import ipywidgets as widgets
import numpy as np
from traitlets import Unicode

from imgproc_course.display.controls import Controls
from imgproc_course.display.figures import check_image, is_scaled, resize, to_rgb

GAP = 6
WIDTH, WIDTH_OF_SEVERAL, HIGHEST = 640, 960, 480
QUALITY = 80


class Style(NamedTuple):
    """How a view shows its images; `live_view` describes it."""

    encoding: str = "bgr8"
    width: int | None = None
    limits: tuple[float, float] | None = None
    caption: str | None = None
    alt: str | None = None


class View:
    """What a live view and a tuner have in common: a screen, and controls of a function's parameters."""

    _name: str
    _screen: "Screen"
    _controls: Controls | None

    @property
    def parameters(self) -> dict[str, Any]:
        """Dict of parameter -> value, as the function gets them."""
        return self._controls.values if self._controls else {}

    @property
    def call(self) -> str:
        """The function's call with the current values, as code to copy."""
        return self._controls.call if self._controls else f"{self._name}(frame)"

    def reset(self) -> None:
        """Sets every slider back to its start."""
        if self._controls:
            self._controls.reset()


class NamedImage(widgets.Image):
    """An image widget whose tooltip a screen reader reads as its name.

    ipywidgets 8.1 shows a tooltip only on widgets that have a description, and fails on the others.
    """

    description = Unicode("").tag(sync=True)


class Screen:
    """Shows arrays in one ipywidgets image; any thread may call it: it only assigns to existing widgets."""

    def __init__(self, style, alt):
        self._style = style
        self._size = (0, 0)
        common = {"max_width": "calc(100% - 4px)", "margin": "2px"}
        layout = widgets.Layout(height="auto", **common)
        self.image = NamedImage(format="jpeg", layout=layout, tooltip=style.alt or style.caption or alt)
        self._titles = widgets.HTML(layout=widgets.Layout(**common))
        # It appears with the first text and keeps a height: texts that come and go must not move the page.
        layout = widgets.Layout(min_height="62px", display="none", **common)
        self._message = widgets.HTML(layout=layout)
        width = style.width or WIDTH
        self._resize(width, round(width * 9 / 16))
        self.image.value = _encode(np.full((self._size[1], width), 230, np.uint8))
        caption_line = [widgets.HTML(html.escape(style.caption))] if style.caption else []
        self.box = widgets.VBox([self._titles, self.image, *caption_line, self._message])

    def show(self, result):
        """Shows an array, or several in a list or dict (of title -> array). Returns the JPEG's bytes."""
        images = self._read(result)
        width = self._style.width or (WIDTH if len(images) == 1 else WIDTH_OF_SEVERAL)
        width_of_images = width - GAP * (len(images) - 1)
        height = max(1, min(HIGHEST, round(width_of_images / sum(map(_aspect, images)))))
        self._resize(width, height)
        jpeg = _encode(self._side_by_side(images, height))
        self._set_titles(images)
        self.image.value = jpeg
        return jpeg

    def say(self, text="", *, is_error=False):
        """Writes a line under the image; red if it is an error."""
        colour = "color: var(--jp-error-color1, #b00020);" if is_error else ""
        line = f'<div style="{colour} line-height: 1.35; white-space: pre-wrap">{html.escape(text)}</div>'
        if line != self._message.value:
            self._message.value = line
        if text:
            self._message.layout.display = None

    def _read(self, result):
        titles, arrays = _split_result(result)
        images = []
        for k, (title, array) in enumerate(zip(titles, arrays, strict=True)):
            name = title or ("the result" if len(arrays) == 1 else f"result {k}")
            image = check_image(array, self._style.encoding, title, name)
            if is_scaled(image) and self._style.limits is None:
                raise ValueError(
                    f"{name} has dtype {array.dtype}: give the values of black and white, for example "
                    f"limits=({array.min():g}, {array.max():g}), or return uint8"
                )
            images.append(image)
        return images

    def full_size(self, result):
        """(rows, cols) or (rows, cols, 3) uint8, blue first: the image of `show` at full resolution."""
        images = self._read(result)
        return self._side_by_side(images, max(image.array.shape[0] for image in images))

    def _side_by_side(self, images, height):
        parts = [self._fit(image, (max(1, round(height * _aspect(image))), height)) for image in images]
        if len(parts) == 1:
            return parts[0]
        gap = np.full((height, GAP, 3), 255, np.uint8)
        parts = [cv2.cvtColor(part, cv2.COLOR_GRAY2BGR) if part.ndim == 2 else part for part in parts]
        return np.hstack([piece for part in parts for piece in (part, gap)][:-1])

    def _fit(self, image, size):
        array = image.array
        if image.order == "gray" and array.dtype == bool:
            array = array.view(np.uint8) * np.uint8(255)
        elif array.dtype != np.uint8:
            limits = self._style.limits if image.order == "gray" else (0, 1)
            array = to_rgb(image, limits)[:, :, ::-1]
            image = image._replace(order="bgr")
        array = resize(array, size)
        if image.order in ("gray", "bgr"):
            return array
        return to_rgb(image._replace(array=array), (0, 255))[:, :, ::-1]

    def _resize(self, width, height):
        if (width, height) != self._size:
            self._size = width, height
            self.image.width, self.image.height = str(width), str(height)  # a narrow page shrinks both
            for widget in (self.image, self._titles, self._message):
                widget.layout.width = f"{width}px"

    def _set_titles(self, images):
        text = ""
        if any(image.title for image in images):
            cells = ""
            for image in images:
                style = f"flex: {_aspect(image):.4f}; text-align: center"
                cells += f'<div style="{style}">{html.escape(image.title)}</div>'
            text = f'<div style="display: flex; gap: {GAP}px">{cells}</div>'
        if text != self._titles.value:
            self._titles.value = text


def _aspect(image):
    return image.array.shape[1] / image.array.shape[0]


def _split_result(result):
    """Titles and arrays of what a learner's function returned."""
    if result is None:
        raise ValueError("the function returned None; it must end with `return` and the array to show")
    if isinstance(result, dict):
        titles, arrays = [str(title) for title in result], list(result.values())
    elif isinstance(result, (list, tuple)):
        titles, arrays = [""] * len(result), list(result)
    else:
        titles, arrays = [""], [result]
    if not arrays:
        raise ValueError("the function returned no image: an empty list or dict")
    return titles, arrays


def _encode(image):
    return cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])[1].tobytes()
