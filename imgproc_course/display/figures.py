"""Still images in a notebook: side by side, on one scale, with a caption and an alternative text."""

import base64
import contextlib
import html
import itertools
import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import cv2
import matplotlib as mpl
import numpy as np
from IPython.display import display
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from imgproc_course.messages import encoding_info

# All lengths are CSS pixels, as the reader's browser counts them.
FIGURE_WIDTH = 900
IMAGE_WIDTH, IMAGE_HEIGHT = 640, 420
CELL_SIDE, NUMBERED_CELL_SIDE = 32, 46
LEFT, RIGHT, TOP, BOTTOM = 54, 14, 28, 42
BAR_GAP, BAR_WIDTH, BAR_LABELS = 10, 12, 46
BAR = BAR_GAP + BAR_WIDTH + BAR_LABELS
MOST_NUMBERED = 12
# Drawn with more pixels than shown, so that text stays sharp on a dense screen.
DENSITY = 1.5
LARGEST_PNG = 100_000
SMALLEST_SCALE = 0.8  # of the images of a line in a narrow window; in a narrower one, the line breaks

CHANNEL_ORDERS = {"bgr": (2, 1, 0), "rgb": (0, 1, 2), "bgra": (2, 1, 0, 3), "rgba": (0, 1, 2, 3)}
OPENCV_ORDERS = {1: "gray", 3: "bgr", 4: "bgra"}  # of the generic 8UC1, 8UC3, 8UC4


Images: TypeAlias = np.ndarray | Sequence[np.ndarray] | Mapping[str, np.ndarray]


class CheckedImage(NamedTuple):
    """An image that can be shown: its values, and the order of its channels."""

    array: np.ndarray  # (H, W), or (H, W, 3 or 4) in the order of `order`
    order: str  # "gray", "bgr", "rgb", "bgra", "rgba"
    title: str
    first_row: int
    first_col: int


def show(
    images: Images,
    titles: str | Sequence[str] | None = None,
    *,
    encoding: str | Sequence[str] = "bgr8",
    text: str | None = None,
    alt: str | None = None,
    caption: str | None = None,
    limits: tuple[float, float] | None = None,
    cmap: str = "gray",
    rows: tuple[int, int] | None = None,
    cols: tuple[int, int] | None = None,
    numbers: bool | None = None,
    columns: int | None = None,
) -> None:
    """Shows one image, or several side by side on one scale.

    In every uint8 image 0 is black and 255 is white; in every bool image False is black and True is white.
    All gray images of other dtypes share one scale, which a bar beside them shows: from -m to m if any value
    is negative, else from 0 to m; m is the largest magnitude of all.

    Parameters
    ----------
    images : (H, W) or (H, W, C) array, or a list of them, or a dict of title -> array
        Gray: any real dtype. Colour: uint8 0..255, or float 0..1.
    titles : str or list of str, one per image
    encoding : str or list of str, one per image
        Channel order of colour images: "bgr8", "rgb8", "bgra8", "rgba8", "8UC3" (bgr). An (H, W) array is
        gray under each of these. "mono8", "mono16", "16UC1", "32FC1" and similar ones require their dtype.
    text : "<lesson>/<name>"
        Names both texts of the figure in texts/<lesson>.json, in the current folder or in the course's,
        instead of `caption` and `alt`. A missing file or name makes the figure one without texts.
    alt : str
        Alternative text: what the figure shows. If omitted, it is made of titles and sizes.
    caption : str
        A sentence under the figure.
    limits : (low, high)
        The values shown black and white, for all gray images. Pointed ends of the bar mark values outside.
    cmap : str
        Name of a matplotlib colour map for gray images: "hsv" for directions.
    rows, cols : (start, stop), in pixels
        Shows only this part, enlarged; the axes keep the pixel numbers of the whole image.
    numbers : bool
        Writes each value into its pixel. If omitted: only in images of at most 12 × 12.
    columns : int
        Images in one row of the figure. If omitted: as many as stay legible.

    Raises
    ------
    ValueError : a shape, dtype, encoding, range or count that cannot be shown
    """
    figure, _ = draw(images, titles, encoding, limits, cmap, rows, cols, numbers, columns)
    caption, alt = split_text(text, caption, alt)
    show_figure(figure, alt=alt or str(figure.get_label()), caption=caption)


def draw(
    images: Images,
    titles: str | Sequence[str] | None = None,
    encoding: str | Sequence[str] = "bgr8",
    limits: tuple[float, float] | None = None,
    cmap: str = "gray",
    rows: tuple[int, int] | None = None,
    cols: tuple[int, int] | None = None,
    numbers: bool | None = None,
    columns: int | None = None,
) -> tuple[Figure, list[Axes]]:
    """Draws the figure of `show` without showing it: draw arrows, circles or text on it, then `show_figure`.

    Returns
    -------
    figure : matplotlib Figure
    axes : list of matplotlib Axes, one per image; x is the column, y the row; pixel centres have integer x, y
    """
    checked_images = _check_images(images, titles, encoding, rows, cols)
    scale = _check_limits(limits, checked_images)
    panels = []
    for image in checked_images:
        is_barred = is_scaled(image) or (limits is not None and image.order == "gray")
        panels.append(_Panel(image, _is_numbered(image, numbers), is_barred))
    with mpl.rc_context():
        mpl.rcdefaults()  # a learner's dark style must not change what a lesson shows
        figure, axes = _draw_panels(panels, scale, cmap, columns)
    figure.set_label("; ".join(_describe(image) for image in checked_images))
    return figure, axes


def show_figure(
    figure: Figure, *, alt: str | None = None, caption: str | None = None, text: str | None = None
) -> None:
    """Shows any matplotlib figure as an image with an alternative text, and closes it.

    The stored output has the same bytes whenever the same figure is drawn.

    Parameters
    ----------
    figure : matplotlib Figure
    alt : str, what the figure shows
    caption : str, a sentence under the figure
    text : name of both texts, as in `show`, instead of `caption` and `alt`
    """
    caption, alt = split_text(text, caption, alt)
    if text is not None and alt is None:
        titles = [figure.get_suptitle(), *(axes.get_title() for axes in figure.axes)]
        alt = "; ".join(filter(None, titles)) or "a figure"
    if not isinstance(alt, str) or not alt.strip():
        raise ValueError(f"alt must say in words what the figure shows, got {alt!r}")
    display(Output(caption or alt, _figure_html(_encode(figure), alt, caption)))
    pyplot = sys.modules.get("matplotlib.pyplot")  # not imported here: it chooses a backend
    if pyplot is not None:
        pyplot.close(figure)  # or it would be shown a second time at the end of its cell


def split_text(
    text: str | None, caption: str | None = None, alt: str | None = None
) -> tuple[str | None, str | None]:
    """(caption, alt) of a figure: those stored by its `text`, if it has one; None if there are none."""
    if text is None:
        return caption, alt
    if caption is not None or alt is not None:
        raise ValueError("give text=, or caption= and alt=, not both")
    if not isinstance(text, str):
        raise ValueError(f'text must be "lesson/name", got {text!r}; give your own as caption= and alt=')
    lesson, _, figure = text.partition("/")
    for folder in (Path(), Path(__file__).parents[2] / "notebooks"):
        with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
            texts = json.loads((folder / "texts" / f"{lesson}.json").read_text(encoding="utf-8"))
            return str(texts[figure]["caption"]), str(texts[figure]["alt"])
    return None, None


class Output:
    """Something as a notebook stores it: HTML, text, and the widget, which only a running kernel shows.

    Of runs that differ, the texts are equal; only the id of the widget is another one.
    """

    def __init__(self, text, html, widget=None):
        self.text, self.html, self._widget = text, html, widget

    def _repr_mimebundle_(self, include=None, exclude=None):
        bundle = self._widget._repr_mimebundle_() or {} if self._widget is not None else {}
        return {**bundle, "text/html": self.html, "text/plain": self.text}

    def __repr__(self):
        return self.text


def _figure_html(lines, alt, caption):
    """A figure as HTML: JupyterLab supports an alternative text in no other form.

    Each part is an image of its own, so that the images of a line stand below each other in a narrow window.
    """
    # JupyterLab 4.6 writes "Image" in place of an empty alternative text.
    alts = itertools.chain([html.escape(alt)], itertools.repeat("continued"))
    blocks = [[_img_tag(part, next(alts), len(line)) for part in line] for line in lines]
    if len(blocks) == len(blocks[0]) == 1:
        images = blocks[0][0]
    else:
        style = "display: flex; flex-wrap: wrap; align-items: flex-start"
        images = "".join(f'<div style="{style}">{"".join(block)}</div>' for block in blocks)
    style = f"max-width: {FIGURE_WIDTH}px"
    figcaption = f'<figcaption style="{style}">{html.escape(caption)}</figcaption>' if caption else ""
    return f'<figure style="margin: 0">{images}{figcaption}</figure>'


def _img_tag(part, alt, count):
    """The HTML of one of the `count` images of a line."""
    kind, data, width = part
    style = "max-width: 100%; height: auto"
    if count > 1:
        narrowest = round(SMALLEST_SCALE * width)
        style = f"flex: {width} 1 {narrowest}px; min-width: 0; max-width: min(100%, {width}px); height: auto"
    source = f"data:image/{kind};base64,{base64.b64encode(data).decode()}"
    return f'<img alt="{alt}" width="{width}" style="{style}" src="{source}">'


def _check_images(images, titles, encoding, rows, cols):
    if isinstance(images, dict):
        if titles is not None:
            raise ValueError("the keys of a dict are the titles; omit `titles`, or give a list of images")
        titles, images = [str(title) for title in images], list(images.values())
    single = isinstance(images, np.ndarray)
    images = [images] if single else images
    if not isinstance(images, (list, tuple)) or not images:
        raise ValueError(f"nothing to show: expected an array or a list of them, got {type(images).__name__}")
    titles = _one_per_image(titles, len(images), "titles", default="")
    encodings = _one_per_image(encoding, len(images), "encodings", repeat=True)
    names = ["the image"] if len(images) == 1 else [f"image {k}" for k in range(len(images))]
    return [
        _crop(check_image(array, code, title, name), rows, cols, name)
        for array, code, title, name in zip(images, encodings, titles, names, strict=True)
    ]


def _one_per_image(values, count, name, default=None, repeat=False):
    if values is None:
        return [default] * count
    if isinstance(values, str):
        values = [values] * count if repeat else [values]
    if len(values) != count:
        raise ValueError(f"{len(values)} {name} for {count} images; give one per image")
    return [str(value) for value in values]


def check_image(array, encoding, title, name):
    """A CheckedImage of an array, or a ValueError that names the array and says what is expected."""
    if not isinstance(array, np.ndarray):
        raise ValueError(f"{name} is {type(array).__name__}, not an array; for a list: np.array(...)")
    if array.ndim not in (2, 3) or array.size == 0:
        raise ValueError(f"{name} has shape {array.shape}; expected (rows, cols) or (rows, cols, channels)")
    if array.dtype.kind not in "buif":
        raise ValueError(f"{name} has dtype {array.dtype}; expected numbers, such as array.astype(np.uint8)")
    if array.dtype.kind == "f" and not np.isfinite(array).all():
        raise ValueError(f"{name} contains NaN or infinity; np.nan_to_num(array) replaces them")
    if array.ndim == 3 and array.shape[2] == 1:
        array = array[:, :, 0]
    order, dtype = _read_encoding(encoding, name)
    if array.ndim == 3:
        _check_colour(array, order, encoding, name)
        return CheckedImage(array, order, title, 0, 0)
    if order == "gray" and array.dtype != dtype and not (dtype == np.uint8 and array.dtype == bool):
        raise ValueError(
            f"{name} has dtype {array.dtype}, but encoding {encoding!r} means {dtype}; "
            "omit `encoding` to show a gray array of any dtype on its own scale"
        )
    return CheckedImage(array, "gray", title, 0, 0)


def _read_encoding(encoding, name):
    """Channel order and dtype of an encoding; an unknown name raises ConversionError, a ValueError."""
    info = encoding_info(encoding)
    order = info.color or OPENCV_ORDERS.get(info.channels)
    if order != "gray" and order not in CHANNEL_ORDERS:
        raise ValueError(
            f"{name} has encoding {encoding!r}, which cannot be shown directly: convert it first, with "
            'image_to_array(msg, "bgr8"), or use one of bgr8, rgb8, bgra8, rgba8, mono8, mono16, 32FC1'
        )
    return order, info.dtype


def _check_colour(array, order, encoding, name):
    channels = len(CHANNEL_ORDERS.get(order, "1"))
    if array.shape[2] != channels:
        expected_shape = "(rows, cols)" if channels == 1 else f"(rows, cols, {channels})"
        remedies = {3: 'encoding="bgr8"', 4: 'encoding="bgra8"'}
        remedy = remedies.get(array.shape[2], "array[:, :, k] for one channel")
        raise ValueError(
            f"{name} has shape {array.shape}, but encoding {encoding!r} means {expected_shape}; try {remedy}"
        )
    if array.dtype.kind == "f":
        if array.min() < 0 or array.max() > 1:
            raise ValueError(
                f"{name} is a float colour image with values {array.min():g} to {array.max():g}; "
                "expected 0..1: divide by 255, or np.clip(array, 0, 255).astype(np.uint8)"
            )
    elif array.dtype != np.uint8:
        raise ValueError(
            f"{name} is a colour image of dtype {array.dtype}; expected uint8 or float 0..1: "
            "np.clip(array, 0, 255).astype(np.uint8) if its values are 0..255"
        )


def _crop(image, rows, cols, name):
    for axis, part, size in (("rows", rows, image.array.shape[0]), ("cols", cols, image.array.shape[1])):
        if part is not None and not (len(part) == 2 and 0 <= part[0] < part[1] <= size):
            raise ValueError(f"{axis}={part} is not inside {name}: expected (start, stop) within 0..{size}")
    first_row, stop_row = rows or (0, image.array.shape[0])
    first_col, stop_col = cols or (0, image.array.shape[1])
    part = image.array[first_row:stop_row, first_col:stop_col]
    return image._replace(array=part, first_row=first_row, first_col=first_col)


def is_scaled(image):
    """Whether its values need a scale: for uint8, bool and colour, black and white are fixed."""
    return image.order == "gray" and image.array.dtype not in (np.uint8, np.bool_)


def _check_limits(limits, images):
    if limits is not None:
        low, high = limits
        if not low < high:
            raise ValueError(f"limits={limits!r}: the value shown black must be below the value shown white")
        return float(low), float(high)
    scaled = [image.array for image in images if is_scaled(image)]
    low = min((float(array.min()) for array in scaled), default=0.0)
    high = max((float(array.max()) for array in scaled), default=0.0)
    largest = max(-low, high) or 1.0
    return (-largest, largest) if low < 0 else (0.0, largest)


def _is_numbered(image, numbers):
    if numbers is None:
        return max(image.array.shape[:2]) <= MOST_NUMBERED
    if numbers and max(image.array.shape[:2]) > 2 * MOST_NUMBERED:
        raise ValueError(
            f"numbers=True needs at most {2 * MOST_NUMBERED} rows and cols to stay legible, "
            f"got {image.array.shape}; rows=(start, stop) and cols=(start, stop) show a part"
        )
    return bool(numbers)


def _describe(image):
    height, width = image.array.shape[:2]
    kind = "gray" if image.order == "gray" else "colour"
    position = ""
    if image.first_row or image.first_col:
        position = f" from row {image.first_row}, col {image.first_col}"
    return f"{image.title or 'image'} ({kind}, {height} rows by {width} cols{position})"


@dataclass
class _Panel:
    """An image of a figure, and its place: CSS pixels, from the figure's upper left corner."""

    image: CheckedImage
    is_numbered: bool
    is_barred: bool  # on the shared scale, which a bar shows
    box: tuple[int, int] = (0, 0)  # width and height of the image alone
    has_bar: bool = False
    left: int = 0
    top: int = 0
    height: int = 0

    @property
    def width(self):
        return LEFT + self.box[0] + RIGHT + (BAR if self.has_bar else 0)

    def is_cramped(self):
        """Whether its numbers do not fit into its pixels."""
        longest = max(len(_number(value)) for value in self.image.array.flat) if self.is_numbered else 0
        return self.is_numbered and self.box[0] / self.image.array.shape[1] < 6 * longest + 4


def _draw_panels(panels, scale, cmap, columns):
    count = _choose_boxes(panels, columns)
    lines = [panels[k : k + count] for k in range(0, len(panels), count)]
    height = 0
    for line in lines:
        _place_line(line, height)
        height += line[0].height
    width = max(line[-1].left + line[-1].width for line in lines)
    figure: Any = Figure(figsize=(width / 100, height / 100), dpi=100 * DENSITY)
    FigureCanvasAgg(figure)
    figure.panels, axes = lines, []  # `_encode` makes an image of each
    for line in lines:
        for panel in line:
            axes.append(_draw_image(figure, panel, scale, cmap))
            if panel.has_bar:
                _draw_bar(figure, panel, scale, cmap, [p.image.array for p in line if p.is_barred])
    return figure, axes


def _choose_boxes(panels, columns):
    """Sets each panel's box; returns the largest number of images per line at which each stays legible."""
    if columns is not None and columns < 1:
        raise ValueError(f"columns={columns}: a line has at least one image")
    bar = BAR if any(panel.is_barred for panel in panels) else 0
    for count in [columns] if columns else range(min(len(panels), 4), 0, -1):
        widest = (FIGURE_WIDTH - bar) // count - LEFT - RIGHT
        for panel in panels:
            panel.box = _fit(panel.image, widest, panel.is_numbered)
        if not any(panel.is_cramped() for panel in panels):
            break
    return count


def _place_line(line, top):
    height = TOP + max(panel.box[1] for panel in line) + BOTTOM
    left = 0
    for panel in line:
        # If every image of a line is on the shared scale, one bar at the end of the line is enough.
        panel.has_bar = panel.is_barred and (panel is line[-1] or not all(p.is_barred for p in line))
        panel.left, panel.top, panel.height = left, top, height
        left += panel.width


def _place(figure, left, top, width, height):
    """A box in CSS pixels from the top left corner, as matplotlib's fractions from the bottom left corner."""
    whole_width, whole_height = figure.get_size_inches() * 100
    return left / whole_width, 1 - (top + height) / whole_height, width / whole_width, height / whole_height


def _fit(image, widest, numbered):
    height, width = image.array.shape[:2]
    widest, highest = min(widest, IMAGE_WIDTH), IMAGE_HEIGHT
    if max(height, width) <= 2 * MOST_NUMBERED:
        side = NUMBERED_CELL_SIDE if numbered else CELL_SIDE
        if numbered and image.array.ndim == 3:
            side += 10
        widest, highest = min(widest, side * width), min(IMAGE_WIDTH, side * height)
    factor = min(widest / width, highest / height)
    if factor > 1:
        factor = int(factor)  # so that every pixel has the same size
    return max(1, round(width * factor)), max(1, round(height * factor))


def _draw_image(figure, panel, scale, cmap):
    image, box = panel.image, panel.box
    axes = figure.add_axes(_place(figure, panel.left + LEFT, panel.top + TOP, *box))
    height, width = image.array.shape[:2]
    white = 1 if image.array.dtype == bool else 255
    colours = to_rgb(image, scale if panel.is_barred else (0, white), cmap)
    left, top = image.first_col - 0.5, image.first_row - 0.5
    pixels = resize(colours, [max(1, round(side * DENSITY)) for side in box])
    extent = (left, left + width, top + height, top)
    axes.imshow(pixels, extent=extent, interpolation="nearest", aspect="auto")
    axes.set_title(image.title, fontsize=10, pad=5)
    axes.set_xlabel("col", fontsize=9, labelpad=2)
    axes.set_ylabel("row", fontsize=9, labelpad=2)
    axes.tick_params(labelsize=8, length=3)
    for axis, size in ((axes.xaxis, width), (axes.yaxis, height)):
        most_ticks = size if panel.is_numbered else 5
        axis.set_major_locator(MaxNLocator(most_ticks, integer=True, steps=[1, 2, 5, 10]))
    if panel.is_numbered:
        _write_numbers(axes, image, colours, box[0] / width)
    axes.set_xlim(left, left + width)
    axes.set_ylim(top + height, top)
    return axes


def to_rgb(image, limits, cmap="gray"):
    """(H, W, 3) uint8, red first. Gray values go through a colour map, whose first colour means limits[0]."""
    array = image.array
    if image.order != "gray":
        if array.dtype.kind == "f":
            array = np.rint(array * 255).astype(np.uint8)
        array = array[:, :, CHANNEL_ORDERS[image.order]]
        return np.ascontiguousarray(_on_white(array) if array.shape[2] == 4 else array)
    low, high = limits
    levels = np.clip((array.astype(np.float64) - low) * 255 / (high - low), 0, 255)
    table = mpl.colormaps[cmap](np.arange(256), bytes=True)[:, :3]
    return table[np.rint(levels).astype(np.uint8)]


def _on_white(rgba):
    opacity = rgba[:, :, 3:].astype(np.uint32)
    return ((rgba[:, :, :3] * opacity + 255 * (255 - opacity) + 127) // 255).astype(np.uint8)


def resize(array, size):
    """Resizes to (width, height): shrinking averages, so that thin edges stay; growing copies."""
    shrinks = size[0] < array.shape[1]
    return cv2.resize(array, size, interpolation=cv2.INTER_AREA if shrinks else cv2.INTER_NEAREST)


def _number(value):
    if isinstance(value, (np.bool_, bool)):
        return str(int(value))
    return str(value) if isinstance(value, np.integer) else f"{value:.3g}"


def _write_numbers(axes, image, colours, cell):
    luma = colours @ np.array([0.299, 0.587, 0.114])
    channels = "" if image.array.ndim == 2 else image.order
    longest = max(len(_number(value)) for value in image.array.flat)
    points = max(5, min(10, 1.05 * cell / max(4, longest + 1), 0.6 * cell / max(1, len(channels))))
    if channels:
        axes.set_xlabel(f"col (in each pixel, from the top: {', '.join(channels)})", fontsize=9, labelpad=2)
    for row, col in np.ndindex(luma.shape):
        text = "\n".join(_number(value) for value in np.atleast_1d(image.array[row, col]))
        color = "black" if luma[row, col] > 127 else "white"
        x, y = col + image.first_col, row + image.first_row
        axes.text(x, y, text, color=color, fontsize=points, ha="center", va="center")


def _draw_bar(figure, panel, scale, cmap, arrays):
    left = panel.left + LEFT + panel.box[0] + BAR_GAP
    axes = figure.add_axes(_place(figure, left, panel.top + TOP, BAR_WIDTH, panel.box[1]))
    low, high = scale
    below = any(array.min() < low for array in arrays)
    above = any(array.max() > high for array in arrays)
    extend = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}
    scale_colours = ScalarMappable(Normalize(low, high), cmap)
    figure.colorbar(scale_colours, cax=axes, extend=extend[below, above])
    axes.tick_params(labelsize=8, length=3)


def _encode(figure):
    """Lines of images: kind, bytes and CSS width of each. A figure without panels is one image."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    bgr = cv2.cvtColor(np.asarray(canvas.buffer_rgba()), cv2.COLOR_RGBA2BGR)
    width, height = (round(side * 100) for side in figure.get_size_inches())
    panels = getattr(figure, "panels", ())
    if sum(map(len, panels)) < 2:
        return [[_encode_image(bgr, width, LARGEST_PNG)]]
    largest_png = LARGEST_PNG // sum(map(len, panels))
    return [
        [_encode_image(_part(bgr, panel, (width, height)), panel.width, largest_png) for panel in line]
        for line in panels
    ]


def _part(bgr, panel, size):
    """The pixels of a panel of a figure of this size in CSS pixels."""
    col_scale, row_scale = bgr.shape[1] / size[0], bgr.shape[0] / size[1]
    rows = slice(round(panel.top * row_scale), round((panel.top + panel.height) * row_scale))
    return bgr[rows, round(panel.left * col_scale) : round((panel.left + panel.width) * col_scale)]


def _encode_image(bgr, width, largest_png):
    """Kind, bytes and CSS width: PNG if it is small, as for numbers and edges; JPEG for photographs."""
    quick_png = _png(bgr, 1)
    options = [cv2.IMWRITE_JPEG_QUALITY, 88, cv2.IMWRITE_JPEG_OPTIMIZE, 1]
    jpeg = cv2.imencode(".jpg", bgr, options)[1] if quick_png.size > largest_png else None
    # The smallest PNG of a photograph takes a second to make. Over all figures of the lessons it has at least
    # two thirds of the bytes of a quick PNG: if the quick one is more than twice too large, do not try.
    if jpeg is None or quick_png.size <= 2 * max(largest_png, jpeg.size):
        png = _png(bgr, 9)
        if jpeg is None or png.size <= largest_png or png.size < jpeg.size:
            return "png", png.tobytes(), width
    return "jpeg", jpeg.tobytes(), width


def _png(bgr, effort):
    return cv2.imencode(".png", bgr, [cv2.IMWRITE_PNG_COMPRESSION, effort])[1]
