"""Sliders, boxes and lists for the parameters of a learner's function."""

import difflib
import html
import inspect
import math

import ipywidgets as widgets

PAIRS = (
    ("low", "high"),
    ("lower", "upper"),
    ("minimum", "maximum"),
    ("min", "max"),
    ("threshold1", "threshold2"),
)


class Controls:
    """One widget for each keyword, and the values they stand for.

    Parameters
    ----------
    function : the function whose parameters they are
    ranges : dict of keyword -> what it may be
        (low, high) or (low, high, step): a slider, of integers if all are integers;
        True or False: a box to tick, starting there;
        a list, or a dict of label -> value: a choice, starting at the parameter's default or the first;
        any ipywidgets widget with a value: that.
        A keyword that is no parameter of the function stands for the pair of its parameters that must not
        cross, (low, high) by whatever name in PAIRS: one range slider sets both.
    on_change : called without arguments when a value changed

    Raises
    ------
    ValueError : a range that is none, a keyword that the function does not know
    """

    def __init__(self, function, ranges, on_change=lambda: None):
        self._function, self._parameters = function, _parameters(function)
        self._names = {}  # keyword -> the parameters it sets
        self._widgets = {}
        for keyword, given in ranges.items():
            self._names[keyword] = self._find(keyword, given, function)
            self._widgets[keyword] = self._make(keyword, given)
        names = [name for both in self._names.values() for name in both]
        if len(set(names)) < len(names):
            raise ValueError(f"{', '.join(ranges)} set a parameter twice; leave one of them out")
        self._starts = {keyword: widget.value for keyword, widget in self._widgets.items()}
        self._values = self._read()
        self._on_change = on_change
        for widget in self._widgets.values():
            widget.observe(self._changed, "value")
        reset = widgets.Button(description="Reset", icon="undo", layout=widgets.Layout(width="110px"))
        reset.on_click(lambda _: self.reset())
        self._code = widgets.HTML(layout=widgets.Layout(width="auto"))
        self._note = ""
        self._write_code()
        # Beside the picture while a slider there is long enough to be set by hand, else under it, as wide.
        column = widgets.Layout(flex="1 1 420px", max_width="640px")
        self.box = widgets.VBox([*self._widgets.values(), reset, self._code], layout=column)

    @property
    def values(self):
        """Dict of parameter -> value, as the function is called."""
        return dict(self._values)

    @property
    def call(self):
        """The function's call with the present values, as code."""
        first = next(iter(self._parameters or ()), "frame")
        given = ", ".join([first, *(f"{name}={_spell(value)}" for name, value in self._values.items())])
        return f"{_name(self._function)}({given})"

    def note(self, words):
        """Words under the code."""
        self._note = f"<div>{html.escape(words)}</div>"
        self._write_code()

    def reset(self):
        """Puts every control back to where it began."""
        for keyword, widget in self._widgets.items():
            widget.value = self._starts[keyword]

    def __getitem__(self, keyword):
        return self._widgets[keyword]

    def _changed(self, _):
        self._values = self._read()
        self._on_change()  # first, because the picture is what the eye waits for
        self._write_code()

    def _write_code(self):
        # One click selects it all, ready to be copied.
        style = "user-select: all; white-space: pre-wrap; overflow-wrap: anywhere"
        # Code and note are one message: on its way to the eye a picture waits for every other one.
        self._code.value = f'<code style="{style}">{html.escape(self.call)}</code>{self._note}'

    def _read(self):
        values = {}
        for keyword, names in self._names.items():
            value = self._widgets[keyword].value
            values.update(zip(names, value, strict=True) if len(names) == 2 else [(names[0], value)])
        return values

    def _find(self, keyword, given, function):
        known = self._parameters
        if known is None or keyword in known or any(p.kind is p.VAR_KEYWORD for p in known.values()):
            return (keyword,)
        pairs = [pair for pair in PAIRS if set(pair) <= set(known)]
        others = [name for name in known if not pairs or name not in pairs[0]]
        meant = difflib.get_close_matches(keyword, others, 1, 0.75)
        if len(pairs) == 1 and isinstance(getattr(given, "value", given), tuple) and not meant:
            return pairs[0]
        raise ValueError(
            f"{_name(function)} has no parameter {keyword!r}; it has: {', '.join(known)}. "
            + (f"Did you mean {meant[0]}? " if meant else "")
            + "Another name is a range slider for two of them, where they are called low and high"
        )

    def _make(self, keyword, given):
        style = {"description_width": "80px"}
        layout = widgets.Layout(width="auto")
        common = {"description": keyword, "style": style, "layout": layout}
        if isinstance(given, widgets.Widget):
            if not hasattr(given, "value"):
                raise ValueError(f"{keyword}: a {type(given).__name__} has no value to give; use a slider")
            return given
        if isinstance(given, bool):
            return widgets.Checkbox(value=given, **common)
        if isinstance(given, (list, dict)) and len(given):
            options = list(given.items()) if isinstance(given, dict) else given
            values = [value for _, value in options] if isinstance(given, dict) else options
            start = self._default(keyword)
            return widgets.Dropdown(options=options, value=start if start in values else values[0], **common)
        return self._make_slider(keyword, given, common)

    def _make_slider(self, keyword, given, common):
        low, high, step = _check_range(keyword, given)
        whole = all(isinstance(number, int) for number in (low, high, step))
        limits = {"min": low, "max": high, "step": step}
        if not whole:
            common["readout_format"] = f".{max(0, -math.floor(math.log10(step)))}f"
        names = self._names[keyword]
        if len(names) == 2:
            start = tuple(
                self._start(name, low, high, step, share)
                for name, share in zip(names, (0.1, 0.2), strict=True)
            )
            kind = widgets.IntRangeSlider if whole else widgets.FloatRangeSlider
        else:
            start = self._start(keyword, low, high, step, 0.5)
            kind = widgets.IntSlider if whole else widgets.FloatSlider
        return kind(value=start, **limits, **common)

    def _default(self, name):
        parameter = (self._parameters or {}).get(name)
        return None if parameter is None or parameter.default is parameter.empty else parameter.default

    def _start(self, name, low, high, step, share):
        """The parameter's own default where the slider reaches it, else a share of the way."""
        default = self._default(name)
        if isinstance(default, (int, float)) and low <= default <= high:
            return default
        wanted = float(f"{low + (high - low) * share:.1g}")  # 100 reads better than 102
        return min(high, low + step * max(0, round((wanted - low) / step)))


def _parameters(function):
    try:
        return inspect.signature(function).parameters
    except (TypeError, ValueError):  # a function written in C, such as cv2's, may not say
        return None


def _name(function):
    return getattr(function, "__name__", type(function).__name__)


def _spell(value):
    """A slider's 0.30000000000000004 as 0.3, and everything else as code."""
    return repr(float(f"{value:.10g}")) if isinstance(value, float) else repr(value)


def _check_range(keyword, given):
    if not isinstance(given, tuple) or len(given) not in (2, 3) or not all(_is_number(one) for one in given):
        raise ValueError(
            f"{keyword}={given!r} is no range: give (low, high) or (low, high, step) for a slider, "
            "True or False for a box to tick, a list for a choice, or a widget"
        )
    low, high = given[:2]
    if not low < high:
        raise ValueError(f"{keyword}={given!r}: the first number must be below the second")
    if len(given) == 3:
        step = given[2]
        if not 0 < step <= high - low:
            raise ValueError(f"{keyword}={given!r}: the step must be above 0 and fit between the two")
    else:
        whole = isinstance(low, int) and isinstance(high, int)
        step = 1 if whole else 10 ** math.floor(math.log10((high - low) / 50))
    return low, high, step


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
