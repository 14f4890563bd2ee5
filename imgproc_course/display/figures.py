"""Still pictures in a notebook: side by side, on one scale, with a caption and a text for the blind."""

import base64
import html
from typing import NamedTuple

import cv2
import matplotlib as mpl
import numpy as np
from IPython.display import display
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from imgproc_course.messages import encoding_info

# All lengths are CSS pixels, as the reader's browser counts them.
FIGURE_WIDTH = 900
PICTURE_WIDTH, PICTURE_HEIGHT = 640, 420
CELL_SIDE, NUMBERED_CELL_SIDE = 32, 46
LEFT, RIGHT, TOP, BOTTOM = 54, 14, 28, 42
BAR_GAP, BAR_WIDTH, BAR_LABELS = 10, 12, 46
MOST_NUMBERED = 12
# Drawn with more pixels than shown, so that text stays sharp on a dense screen.
DENSITY = 1.5
LARGEST_PNG = 100_000

CHANNEL_ORDERS = {"bgr": (2, 1, 0), "rgb": (0, 1, 2), "bgra": (2, 1, 0, 3), "rgba": (0, 1, 2, 3)}
OPENCV_ORDERS = {1: "gray", 3: "bgr", 4: "bgra"}  # of the generic 8UC1, 8UC3, 8UC4


class Picture(NamedTuple):
    """One checked picture: its values, and which of them is red."""

    array: np.ndarray  # (H, W), or (H, W, 3 or 4) in the order of `order`
    order: str  # "gray", "bgr", "rgb", "bgra", "rgba"
    title: str
    first_row: int
    first_col: int


def show(
    images,
    titles=None,
    *,
    encoding="bgr8",
    alt=None,
    caption=None,
    limits=None,
    cmap="gray",
    rows=None,
    cols=None,
    numbers=None,
    columns=None,
):
    """Shows one picture, or several side by side on one scale.

    uint8 is black at 0 and white at 255, bool is black and white, in every picture. Any other gray dtype
    gets one scale shared by all such pictures, drawn beside them as a bar with its numbers: from -m to m
    where values are negative, else from 0 to m; m is the largest magnitude there is.

    Parameters
    ----------
    images : (H, W) or (H, W, C) array, or a list of them, or a dict of title -> array
        Gray: any real dtype. Colour: uint8 0..255, or float 0..1.
    titles : str or list of str, one a picture
    encoding : str or list of str, one a picture
        Channel order of colour pictures: "bgr8", "rgb8", "bgra8", "rgba8", "8UC3" (bgr). An (H, W) array is
        gray whatever colour is named. "mono8", "mono16", "16UC1", "32FC1" and the like insist on their dtype.
    alt : str
        What is seen, for a reader who does not see it; made of titles and sizes where it is left out.
    caption : str
        A whole sentence under the figure.
    limits : (low, high)
        The values shown black and white, for all gray pictures; the bar points to values outside.
    cmap : str
        Name of a matplotlib colour map for gray pictures: "hsv" for directions.
    rows, cols : (start, stop), in pixels
        Only this part, enlarged; the axes keep the numbers of the whole picture.
    numbers : bool
        Writes each value into its pixel; left out: where a picture is at most 12 × 12.
    columns : int
        Pictures in one row; left out: as many as stay legible.

    Raises
    ------
    ValueError : a shape, dtype, encoding, range or count that cannot be shown as it is told
    """
    figure, _ = draw(
        images,
        titles,
        encoding=encoding,
        limits=limits,
        cmap=cmap,
        rows=rows,
        cols=cols,
        numbers=numbers,
        columns=columns,
    )
    show_figure(figure, alt=alt or figure.get_label(), caption=caption)


def draw(
    images,
    titles=None,
    *,
    encoding="bgr8",
    limits=None,
    cmap="gray",
    rows=None,
    cols=None,
    numbers=None,
    columns=None,
):
    """What `show` shows, before it is shown: to draw arrows, circles or words on it, then `show_figure`.

    Parameters
    ----------
    As `show`.

    Returns
    -------
    figure : matplotlib Figure
    axes : list of matplotlib Axes, one a picture; x is the column, y the row, a pixel's centre is an integer
    """
    pictures = _check_pictures(images, titles, encoding, rows, cols)
    scale = _check_limits(limits, pictures)
    numbered = [_is_numbered(picture, numbers) for picture in pictures]
    with mpl.rc_context():
        mpl.rcdefaults()  # a learner's dark style must not change what a lesson shows
        figure, axes = _lay_out(pictures, numbered, scale, limits, cmap, columns)
    figure.set_label("; ".join(_describe(picture) for picture in pictures))
    return figure, axes


def show_figure(figure, *, alt, caption=None):
    """Shows any matplotlib figure as a picture with a text for who cannot see it, and closes it.

    The stored output holds the same bytes each time the same figure is drawn.

    Parameters
    ----------
    figure : matplotlib Figure
    alt : str, what is seen
    caption : str, a whole sentence under the figure
    """
    if not isinstance(alt, str) or not alt.strip():
        raise ValueError(f"alt must say in words what the figure shows, got {alt!r}")
    kind, data, width = _encode(figure)
    display(_Output(kind, data, width, alt, caption))
    _close(figure)


class _Output:
    """A figure as a notebook stores it: JupyterLab gives an alt text to no other form of picture."""

    def __init__(self, kind, data, width, alt, caption):
        source = f"data:image/{kind};base64,{base64.b64encode(data).decode()}"
        under = (
            f'<figcaption style="max-width: {FIGURE_WIDTH}px">{html.escape(caption)}</figcaption>'
            if caption
            else ""
        )
        self.html = (
            f'<figure style="margin: 0"><img alt="{html.escape(alt)}" width="{width}" '
            f'style="max-width: 100%; height: auto" src="{source}">{under}</figure>'
        )
        self.text = caption or alt

    def _repr_mimebundle_(self, include=None, exclude=None):
        return {"text/html": self.html, "text/plain": self.text}

    def __repr__(self):
        return self.text


# ---------------------------------------------------------------- what may be shown


def _check_pictures(images, titles, encoding, rows, cols):
    if isinstance(images, dict):
        if titles is not None:
            raise ValueError("a dict brings its own titles; leave `titles` out, or give a list of pictures")
        titles, images = [str(title) for title in images], list(images.values())
    single = isinstance(images, np.ndarray)
    images = [images] if single else images
    if not isinstance(images, (list, tuple)) or not images:
        raise ValueError(
            f"nothing to show: expected an array or a list of arrays, got {type(images).__name__}"
        )
    titles = _one_each(titles, len(images), "titles", default="")
    encodings = _one_each(encoding, len(images), "encodings", repeat=True)
    names = ["the picture"] if len(images) == 1 else [f"picture {k}" for k in range(len(images))]
    return [
        _crop(check_picture(array, code, title, name), rows, cols, name)
        for array, code, title, name in zip(images, encodings, titles, names, strict=True)
    ]


def _one_each(given, count, what, default=None, repeat=False):
    if given is None:
        return [default] * count
    if isinstance(given, str):
        given = [given] * count if repeat else [given]
    if len(given) != count:
        raise ValueError(f"{len(given)} {what} for {count} pictures; give one each")
    return [str(one) for one in given]


def check_picture(array, encoding, title, name):
    """A Picture of an array, or a ValueError that names it and says what it should be."""
    if not isinstance(array, np.ndarray):
        raise ValueError(
            f"{name} is {type(array).__name__}, not an array; for numbers in a list: np.array(...)"
        )
    if array.ndim not in (2, 3) or array.size == 0:
        raise ValueError(f"{name} has shape {array.shape}; expected (rows, cols) or (rows, cols, channels)")
    if array.dtype.kind not in "buif":
        raise ValueError(f"{name} has dtype {array.dtype}; expected numbers: array.astype(np.uint8) perhaps")
    if array.dtype.kind == "f" and not np.isfinite(array).all():
        raise ValueError(
            f"{name} holds NaN or infinity, which have no colour; np.nan_to_num(array) replaces them"
        )
    if array.ndim == 3 and array.shape[2] == 1:
        array = array[:, :, 0]
    order, dtype = _read_encoding(encoding, name)
    if array.ndim == 3:
        _check_colour(array, order, encoding, name)
        return Picture(array, order, title, 0, 0)
    if order == "gray" and array.dtype != dtype and not (dtype == np.uint8 and array.dtype == bool):
        raise ValueError(
            f"{name} has dtype {array.dtype}, but encoding {encoding!r} means {dtype}; "
            "leave `encoding` out to show any gray array on a scale of its own"
        )
    return Picture(array, "gray", title, 0, 0)


def _read_encoding(encoding, name):
    """Order and dtype that an encoding stands for; ConversionError, a ValueError, for a name that is none."""
    info = encoding_info(encoding)
    order = info.color or OPENCV_ORDERS.get(info.channels)
    if order != "gray" and order not in CHANNEL_ORDERS:
        raise ValueError(
            f"{name} is said to be {encoding!r}, which is not shown as it is: convert it first, with "
            'image_to_array(msg, "bgr8"), or name one of bgr8, rgb8, bgra8, rgba8, mono8, mono16, 32FC1'
        )
    return order, info.dtype


def _check_colour(array, order, encoding, name):
    channels = len(CHANNEL_ORDERS.get(order, "1"))
    if array.shape[2] != channels:
        wanted = "(rows, cols)" if channels == 1 else f"(rows, cols, {channels})"
        remedy = {3: 'encoding="bgr8"', 4: 'encoding="bgra8"'}.get(
            array.shape[2], "array[:, :, k] for one channel"
        )
        raise ValueError(
            f"{name} has shape {array.shape}, but encoding {encoding!r} means {wanted}; try {remedy}"
        )
    if array.dtype.kind == "f":
        if array.min() < 0 or array.max() > 1:
            raise ValueError(
                f"{name} is a float colour picture with values {array.min():g} to {array.max():g}; "
                "expected 0..1: divide by 255, or np.clip(array, 0, 255).astype(np.uint8)"
            )
    elif array.dtype != np.uint8:
        raise ValueError(
            f"{name} is a colour picture of dtype {array.dtype}; uint8 or float 0..1 is expected: "
            "np.clip(array, 0, 255).astype(np.uint8) if its values are 0..255"
        )


def _crop(picture, rows, cols, name):
    for what, part, size in (("rows", rows, picture.array.shape[0]), ("cols", cols, picture.array.shape[1])):
        if part is not None and not (len(part) == 2 and 0 <= part[0] < part[1] <= size):
            raise ValueError(f"{what}={part} is no part of {name}: expected (start, stop) within 0..{size}")
    first_row, stop_row = rows or (0, picture.array.shape[0])
    first_col, stop_col = cols or (0, picture.array.shape[1])
    part = picture.array[first_row:stop_row, first_col:stop_col]
    return picture._replace(array=part, first_row=first_row, first_col=first_col)


def _is_scaled(picture):
    """Whether black and white need a word: uint8, bool and colour have theirs."""
    return picture.order == "gray" and picture.array.dtype not in (np.uint8, np.bool_)


def _check_limits(limits, pictures):
    if limits is not None:
        low, high = limits
        if not low < high:
            raise ValueError(f"limits={limits!r}: the value shown black must be below the value shown white")
        return float(low), float(high)
    scaled = [picture.array for picture in pictures if _is_scaled(picture)]
    low = min((float(array.min()) for array in scaled), default=0.0)
    high = max((float(array.max()) for array in scaled), default=0.0)
    largest = max(-low, high) or 1.0
    return (-largest, largest) if low < 0 else (0.0, largest)


def _is_numbered(picture, numbers):
    if numbers is None:
        return max(picture.array.shape[:2]) <= MOST_NUMBERED
    if numbers and max(picture.array.shape[:2]) > 2 * MOST_NUMBERED:
        raise ValueError(
            f"numbers=True needs at most {2 * MOST_NUMBERED} rows and cols to stay legible, "
            f"got {picture.array.shape}; rows=(start, stop) and cols=(start, stop) show a part"
        )
    return bool(numbers)


def _describe(picture):
    height, width = picture.array.shape[:2]
    where = (
        f" from row {picture.first_row}, col {picture.first_col}"
        if picture.first_row or picture.first_col
        else ""
    )
    kind = "gray" if picture.order == "gray" else "colour"
    return f"{picture.title or 'picture'} ({kind}, {height} rows by {width} cols{where})"


# ---------------------------------------------------------------- how it is drawn


def _lay_out(pictures, numbered, scale, limits, cmap, columns):
    barred = [_is_scaled(picture) or (limits is not None and picture.order == "gray") for picture in pictures]
    bar = BAR_GAP + BAR_WIDTH + BAR_LABELS if any(barred) else 0
    columns, boxes = _choose_boxes(pictures, numbered, bar, columns)
    lines = [range(k, min(k + columns, len(pictures))) for k in range(0, len(pictures), columns)]
    # One bar at the end of a line serves the line, if every picture in it is on that scale.
    has_bar = [
        barred[k] and (k == line[-1] or not all(barred[j] for j in line)) for line in lines for k in line
    ]
    widths = [LEFT + boxes[k][0] + RIGHT + (bar if has_bar[k] else 0) for k in range(len(pictures))]
    total_width = max(sum(widths[k] for k in line) for line in lines)
    heights = [TOP + max(boxes[k][1] for k in line) + BOTTOM for line in lines]
    figure = Figure(figsize=(total_width / 100, sum(heights) / 100), dpi=100 * DENSITY)
    FigureCanvasAgg(figure)
    axes = []
    for number, line in enumerate(lines):
        left, top = 0, sum(heights[:number])
        for k in line:
            box = _place(figure, left + LEFT, top + TOP, *boxes[k])
            axes.append(
                _draw_picture(
                    figure.add_axes(box), pictures[k], boxes[k], numbered[k], barred[k], scale, cmap
                )
            )
            if has_bar[k]:
                place = _place(figure, left + LEFT + boxes[k][0] + BAR_GAP, top + TOP, BAR_WIDTH, boxes[k][1])
                shown = [pictures[j].array for j in line if barred[j]]
                _draw_bar(figure, place, scale, cmap, shown)
            left += widths[k]
    return figure, axes


def _place(figure, left, top, width, height):
    """A box in CSS pixels from the top left corner, in matplotlib's fractions from the bottom left one."""
    whole_width, whole_height = figure.get_size_inches() * 100
    return left / whole_width, 1 - (top + height) / whole_height, width / whole_width, height / whole_height


def _choose_boxes(pictures, numbered, bar, columns):
    """Most pictures a line at which each stays legible, and the width and height of each."""
    if columns is not None and columns < 1:
        raise ValueError(f"columns={columns}: at least one picture fits a line")
    for count in [columns] if columns else range(min(len(pictures), 4), 0, -1):
        room = (FIGURE_WIDTH - bar) // count - LEFT - RIGHT
        boxes = [_fit(picture, room, number) for picture, number in zip(pictures, numbered, strict=True)]
        cramped = any(
            number and box[0] / picture.array.shape[1] < _narrowest_cell(picture)
            for picture, box, number in zip(pictures, boxes, numbered, strict=True)
        )
        if not cramped:
            break
    return count, boxes


def _narrowest_cell(picture):
    return 6 * max(len(_number(value)) for value in picture.array.flat) + 4


def _fit(picture, room, numbered):
    height, width = picture.array.shape[:2]
    widest, highest = min(room, PICTURE_WIDTH), PICTURE_HEIGHT
    if max(height, width) <= 2 * MOST_NUMBERED:
        side = NUMBERED_CELL_SIDE if numbered else CELL_SIDE
        if numbered and picture.array.ndim == 3:
            side += 10
        widest, highest = min(widest, side * width), min(PICTURE_WIDTH, side * height)
    factor = min(widest / width, highest / height)
    if factor > 1:
        factor = int(factor)  # every pixel the same size
    return max(1, round(width * factor)), max(1, round(height * factor))


def _draw_picture(axes, picture, box, numbered, barred, scale, cmap):
    height, width = picture.array.shape[:2]
    colours = to_rgb(picture, _range(picture, barred, scale), cmap)
    left, top = picture.first_col - 0.5, picture.first_row - 0.5
    axes.imshow(
        _resample(colours, box),
        extent=(left, left + width, top + height, top),
        interpolation="nearest",
        aspect="auto",
    )
    axes.set_title(picture.title, fontsize=10, pad=5)
    axes.set_xlabel("col", fontsize=9, labelpad=2)
    axes.set_ylabel("row", fontsize=9, labelpad=2)
    axes.tick_params(labelsize=8, length=3)
    for axis, size in ((axes.xaxis, width), (axes.yaxis, height)):
        axis.set_major_locator(MaxNLocator(size if numbered else 5, integer=True, steps=[1, 2, 5, 10]))
    if numbered:
        _write_numbers(axes, picture, colours, box[0] / width)
    axes.set_xlim(left, left + width)
    axes.set_ylim(top + height, top)
    return axes


def _range(picture, barred, scale):
    if barred:
        return scale
    return (0, 1) if picture.array.dtype == bool else (0, 255)


def to_rgb(picture, limits, cmap="gray"):
    """(H, W, 3) uint8, red first: gray values through a colour map, whose first colour means limits[0]."""
    array = picture.array
    if picture.order != "gray":
        if array.dtype.kind == "f":
            array = np.rint(array * 255).astype(np.uint8)
        array = array[:, :, CHANNEL_ORDERS[picture.order]]
        return np.ascontiguousarray(_on_white(array) if array.shape[2] == 4 else array)
    low, high = limits
    levels = np.clip((array.astype(np.float64) - low) * 255 / (high - low), 0, 255)
    table = mpl.colormaps[cmap](np.arange(256), bytes=True)[:, :3]
    return table[np.rint(levels).astype(np.uint8)]


def _on_white(rgba):
    opacity = rgba[:, :, 3:].astype(np.uint32)
    return ((rgba[:, :, :3] * opacity + 255 * (255 - opacity) + 127) // 255).astype(np.uint8)


def _resample(colours, box):
    """To the pixels of the screen: averaged when it shrinks, so that thin edges stay; else copied."""
    size = tuple(max(1, round(side * DENSITY)) for side in box)
    shrinks = size[0] < colours.shape[1]
    return cv2.resize(colours, size, interpolation=cv2.INTER_AREA if shrinks else cv2.INTER_NEAREST)


def _number(value):
    if isinstance(value, (np.bool_, bool)):
        return str(int(value))
    return str(value) if isinstance(value, np.integer) else f"{value:.3g}"


def _write_numbers(axes, picture, colours, cell):
    luma = colours @ np.array([0.299, 0.587, 0.114])
    channels = "" if picture.array.ndim == 2 else picture.order
    longest = max(len(_number(value)) for value in picture.array.flat)
    points = max(5, min(10, 1.05 * cell / max(4, longest + 1), 0.6 * cell / max(1, len(channels))))
    if channels:
        axes.set_xlabel(f"col (in each pixel, from the top: {', '.join(channels)})", fontsize=9, labelpad=2)
    for row, col in np.ndindex(luma.shape):
        words = [_number(value) for value in np.atleast_1d(picture.array[row, col])]
        axes.text(
            col + picture.first_col,
            row + picture.first_row,
            "\n".join(words),
            color="black" if luma[row, col] > 127 else "white",
            fontsize=points,
            ha="center",
            va="center",
        )


def _draw_bar(figure, place, scale, cmap, shown):
    low, high = scale
    below = any(array.min() < low for array in shown)
    above = any(array.max() > high for array in shown)
    extend = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}
    bar = figure.colorbar(
        ScalarMappable(Normalize(low, high), cmap), cax=figure.add_axes(place), extend=extend[below, above]
    )
    bar.ax.tick_params(labelsize=8, length=3)


# ---------------------------------------------------------------- how it is stored


def _encode(figure):
    """Kind, bytes and CSS width: PNG where it is small, as of numbers and edges; JPEG for photographs."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    bgr = cv2.cvtColor(np.asarray(canvas.buffer_rgba()), cv2.COLOR_RGBA2BGR)
    width = round(figure.get_size_inches()[0] * 100)
    quick = _png(bgr, 1)
    jpeg = _jpeg(bgr) if quick.size > LARGEST_PNG else None
    # The smallest PNG of a photograph takes a second, to be thrown away. Over all figures of the lessons it
    # is at least two thirds of a quick one: one that is twice too large will not do.
    if jpeg is None or quick.size <= 2 * max(LARGEST_PNG, jpeg.size):
        png = _png(bgr, 9)
        if jpeg is None or png.size <= LARGEST_PNG or png.size < jpeg.size:
            return "png", png.tobytes(), width
    return "jpeg", jpeg.tobytes(), width


def _png(bgr, effort):
    return cv2.imencode(".png", bgr, [cv2.IMWRITE_PNG_COMPRESSION, effort])[1]


def _jpeg(bgr):
    return cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, 88, cv2.IMWRITE_JPEG_OPTIMIZE, 1])[1]


def _close(figure):
    """A figure of pyplot's would otherwise be shown a second time at the end of its cell."""
    manager = getattr(figure.canvas, "manager", None)
    if getattr(figure, "number", None) is not None or manager is not None:
        from matplotlib import pyplot as plt

        plt.close(figure)
