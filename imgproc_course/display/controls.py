"""Sliders, check boxes and lists for the parameters of a learner's function."""

import difflib
import html
import inspect
import json
import math
from typing import Any

import ipywidgets as widgets

PAIRS = (
    ("low", "high"),
    ("lower", "upper"),
    ("minimum", "maximum"),
    ("min", "max"),
    ("threshold1", "threshold2"),
)
# ipywidgets 8.1 gives the handles of a slider no name that a screen reader could read. The page may draw the
# sliders after this script has begun.
NAME_HANDLES = """
const nameHandles = tries => {
    const handles = element.closest(".widget-vbox")?.querySelectorAll(".noUi-handle") ?? [];
    if (handles.length < names.length && tries > 0) setTimeout(() => nameHandles(tries - 1), 100);
    else handles.forEach((handle, k) => {
        handle.setAttribute("aria-label", names[k]);
        handle.style.borderColor = "var(--jp-ui-font-color2)";  // white on white in the light theme
    });
};
nameHandles(6000);  // ten minutes: the cell may stand outside the visible part
"""


def labelled(slider: widgets.Widget, names: list[str]) -> widgets.VBox:
    """A box to display in place of a slider, whose handles then have names, which a screen reader reads."""
    return widgets.VBox([slider, _handle_names(names)])


def _handle_names(names):
    """A widget without size that names each handle of the sliders in its box."""
    script = f"const names = {json.dumps(names)};{NAME_HANDLES}"
    output = {"output_type": "display_data", "data": {"application/javascript": script}, "metadata": {}}
    return widgets.Output(outputs=(output,) if names else (), layout=widgets.Layout(display="none"))


def make_button(description, icon, on_click):
    """A button that calls `on_click()`; a narrow window does not cut its text."""
    layout = widgets.Layout(width="110px", flex="none")
    button = widgets.Button(description=description, icon=icon, layout=layout)
    button.on_click(lambda _: on_click())
    return button


def in_a_row(*children):
    """Widgets side by side, or below each other in a narrow window."""
    return widgets.HBox(children, layout=widgets.Layout(flex_flow="row wrap"))


class Controls:
    """One widget per keyword, and the parameter values that the widgets set; `tune` describes the ranges.

    `on_change` is called without arguments after a value has changed.
    """

    def __init__(self, function, ranges, on_change=lambda: None):
        self._name = getattr(function, "__name__", type(function).__name__)
        self._parameters = _parameters(function)
        self._names = {}  # keyword -> names of the one or two parameters that it sets
        self._widgets = {}
        for keyword, range_ in ranges.items():
            self._names[keyword] = self._parameters_of(keyword, range_)
            self._widgets[keyword] = self._make_widget(keyword, range_)
        names = [name for pair in self._names.values() for name in pair]
        if len(set(names)) < len(names):
            raise ValueError(f"{', '.join(ranges)} set a parameter twice; omit one of them")
        self._starts = {keyword: widget.value for keyword, widget in self._widgets.items()}
        self._values = self._read()
        self._on_change = on_change
        for widget in self._widgets.values():
            widget.observe(self._changed, "value")
        reset = make_button("Reset", "undo", self.reset)
        self._code = widgets.HTML(layout=widgets.Layout(width="auto"))
        self._note = ""
        self._write_code()
        # Beside the image while that leaves the sliders long enough to move by hand, else below it.
        column = widgets.Layout(flex="1 1 420px", max_width="640px")
        children = [*self._widgets.values(), self._handle_names(), reset, self._code]
        self.box = widgets.VBox(children, layout=column)

    @property
    def values(self):
        return dict(self._values)

    @property
    def call(self):
        first = next(iter(self._parameters or ()), "frame")
        arguments = ", ".join([first, *(f"{name}={_as_code(value)}" for name, value in self._values.items())])
        return f"{self._name}({arguments})"

    def note(self, text):
        """Writes a line of text under the code."""
        self._note = f"<div>{html.escape(text)}</div>"
        self._write_code()

    def reset(self):
        for keyword, widget in self._widgets.items():
            widget.value = self._starts[keyword]

    def __getitem__(self, keyword):
        return self._widgets[keyword]

    def _changed(self, _):
        self._values = self._read()
        self._on_change()  # first: the learner waits for the image
        self._write_code()

    def _write_code(self):
        # One click selects all of the code, to copy it.
        style = "user-select: all; white-space: pre-wrap; overflow-wrap: anywhere"
        # Code and note are one message: every message before an image delays it.
        self._code.value = f'<code style="{style}">{html.escape(self.call)}</code>{self._note}'

    def _read(self):
        values: dict[str, Any] = {}
        for keyword, names in self._names.items():
            value = self._widgets[keyword].value
            values.update(zip(names, value, strict=True) if len(names) == 2 else [(names[0], value)])
        return values

    def _handle_names(self):
        names = []
        for keyword, parameters in self._names.items():
            if hasattr(self._widgets[keyword], "readout_format"):  # a slider
                is_pair = len(parameters) == 2
                names += [f"{keyword}: {name}" for name in parameters] if is_pair else [keyword]
        return _handle_names(names)

    def _parameters_of(self, keyword, range_):
        parameters = self._parameters
        kinds = [parameter.kind for parameter in (parameters or {}).values()]
        if parameters is None or keyword in parameters or inspect.Parameter.VAR_KEYWORD in kinds:
            return (keyword,)
        pairs = [pair for pair in PAIRS if set(pair) <= set(parameters)]
        single_names = [name for name in parameters if not pairs or name not in pairs[0]]
        close_matches = difflib.get_close_matches(keyword, single_names, 1, 0.75)
        if len(pairs) == 1 and isinstance(getattr(range_, "value", range_), tuple) and not close_matches:
            return pairs[0]
        raise ValueError(
            f"{self._name} has no parameter {keyword!r}; it has: {', '.join(parameters)}. "
            + (f"Did you mean {close_matches[0]}? " if close_matches else "")
            + "A new name makes one range slider for two parameters, if they are called low and high"
        )

    def _make_widget(self, keyword, range_):
        style = {"description_width": "80px"}
        layout = widgets.Layout(width="auto")
        common = {"description": keyword, "style": style, "layout": layout}
        if isinstance(range_, widgets.Widget):
            if not hasattr(range_, "value"):
                raise ValueError(f"{keyword}: a {type(range_).__name__} has no value; use a slider")
            return range_
        if isinstance(range_, bool):
            return widgets.Checkbox(value=range_, **common)
        if isinstance(range_, (list, dict)) and len(range_):
            values = list(range_.values()) if isinstance(range_, dict) else range_
            start = self._default(keyword)
            return widgets.Dropdown(options=range_, value=start if start in values else values[0], **common)
        return self._make_slider(keyword, range_, common)

    def _make_slider(self, keyword, range_, common):
        low, high, step = _check_range(keyword, range_)
        is_integer = all(isinstance(number, int) for number in (low, high, step))
        if not is_integer:
            common["readout_format"] = f".{max(0, -math.floor(math.log10(step)))}f"
        if len(self._names[keyword]) == 2:
            lower, upper = self._names[keyword]
            start = self._start(lower, low, high, step, 0.1), self._start(upper, low, high, step, 0.2)
            slider_class = widgets.IntRangeSlider if is_integer else widgets.FloatRangeSlider
        else:
            start = self._start(keyword, low, high, step, 0.5)
            slider_class = widgets.IntSlider if is_integer else widgets.FloatSlider
        return slider_class(value=start, min=low, max=high, step=step, **common)

    def _default(self, name):
        parameter = (self._parameters or {}).get(name)
        return None if parameter is None or parameter.default is parameter.empty else parameter.default

    def _start(self, name, low, high, step, share):
        """The parameter's own default if the slider reaches it, else a value at this share of the range."""
        default = self._default(name)
        if isinstance(default, (int, float)) and low <= default <= high:
            return default
        start = float(f"{low + (high - low) * share:.1g}")  # 100 reads better than 102
        return min(high, low + step * max(0, round((start - low) / step)))


def _parameters(function):
    try:
        return inspect.signature(function).parameters
    except (TypeError, ValueError):  # a function written in C, such as one of cv2, may not have a signature
        return None


def _as_code(value):
    """A value as code; a slider's 0.30000000000000004 as 0.3."""
    return repr(float(f"{value:.10g}")) if isinstance(value, float) else repr(value)


def _check_range(keyword, range_):
    """(low, high, step) of a slider."""
    if not isinstance(range_, tuple) or len(range_) not in (2, 3) or not all(map(_is_number, range_)):
        raise ValueError(
            f"{keyword}={range_!r} is not a range: give (low, high) or (low, high, step) for a slider, "
            "True or False for a check box, a list for a choice, or a widget"
        )
    low, high = range_[:2]
    if not low < high:
        raise ValueError(f"{keyword}={range_!r}: the first number must be below the second")
    if len(range_) == 3:
        step = range_[2]
        if not 0 < step <= high - low:
            raise ValueError(f"{keyword}={range_!r}: the step must be above 0 and fit between the two")
    else:
        is_integer = isinstance(low, int) and isinstance(high, int)
        step = 1 if is_integer else 10 ** math.floor(math.log10((high - low) / 50))
    return low, high, step


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
