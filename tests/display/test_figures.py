"""What `show` stores in a notebook: the right colours, alternative text, the same bytes every time."""

import base64
import re
import sys

import cv2
import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot as plt

from imgproc_course.display import draw, show, show_figure

figures = sys.modules["imgproc_course.display.figures"]

RED_BGR = np.full((4, 4, 3), (0, 0, 255), np.uint8)


@pytest.fixture
def shown(monkeypatch):
    outputs = []
    monkeypatch.setattr(figures, "display", outputs.append)
    return outputs


def pixels(output):
    """(rows, cols, 3) uint8 of the first stored image, red first, at the density it was drawn with."""
    return stored_image(output.html)


def stored_image(tag):
    data = re.search(r'src="data:image/\w+;base64,([^"]+)"', tag)[1]
    return cv2.imdecode(np.frombuffer(base64.b64decode(data), np.uint8), cv2.IMREAD_COLOR)[:, :, ::-1]


def alt_text(output):
    return re.search(r'alt="([^"]*)"', output.html)[1]


def levels_shown(axes):
    """The gray levels on the screen of a gray image, as (H, W)."""
    screen = axes.images[0].get_array()
    assert (screen[..., 0] == screen[..., 1]).all()
    assert (screen[..., 1] == screen[..., 2]).all()
    return screen[..., 0]


@pytest.mark.parametrize(
    ("encoding", "pixel"),
    [
        ("bgr8", (0, 0, 255)),
        ("rgba8", (255, 0, 0, 255)),
        ("8UC4", (0, 0, 255, 255)),
    ],
)
def test_red_is_red_in_the_stored_image(shown, encoding, pixel):
    assert show(np.full((40, 40, len(pixel)), pixel, np.uint8), encoding=encoding) is None
    stored = pixels(shown[0])
    middle = stored[stored.shape[0] // 2, stored.shape[1] // 2]
    assert abs(middle.astype(int) - (255, 0, 0)).max() <= 3  # JPEG and PNG alike


def test_each_image_has_an_encoding_of_its_own():
    _, axes = draw([RED_BGR, RED_BGR[:, :, ::-1]], encoding=["bgr8", "rgb8"])
    for subplot in axes:
        assert (subplot.images[0].get_array() == (255, 0, 0)).all()


def test_transparent_pixels_are_white():
    _, [axes] = draw(np.array([[[0, 0, 255, 0], [0, 0, 255, 128]]], np.uint8), encoding="bgra8")
    screen = axes.images[0].get_array()
    assert screen[0, 0].tolist() == [255, 255, 255]
    assert screen[-1, -1].tolist() == [255, 127, 127]


def test_uint8_is_never_stretched():
    _, axes = draw([np.full((3, 3), 100, np.uint8), np.array([[100, 101]], np.uint8)])
    assert np.unique(levels_shown(axes[0])).tolist() == [100]
    assert np.unique(levels_shown(axes[1])).tolist() == [100, 101]


def test_bool_is_black_and_white():
    _, [axes] = draw(np.array([[False, True]]))
    assert np.unique(levels_shown(axes)).tolist() == [0, 255]


def test_signed_images_share_a_scale_with_zero_in_its_middle():
    figure, axes = draw([np.array([[-1020, 0]], np.int16), np.array([[0, 510]], np.int32)])
    assert np.unique(levels_shown(axes[0])).tolist() == [0, 128]
    assert np.unique(levels_shown(axes[1])).tolist() == [128, 191]
    bars = [subplot for subplot in figure.axes if subplot not in axes]
    assert [bar.get_ylim() for bar in bars] == [(-1020, 1020)]


def test_unsigned_wide_images_go_from_zero_to_the_largest():
    figure, [axes] = draw(np.array([[0, 1000], [500, 2000]], np.uint16), encoding="16UC1")
    assert np.unique(levels_shown(axes)).tolist() == [0, 64, 128, 255]
    assert figure.axes[-1].get_ylim() == (0, 2000)


def test_limits_hold_for_all_gray_images_and_the_bar_points_beyond():
    figure, axes = draw([np.array([[0, 50, 100]], np.uint8), np.array([[25.0, -5.0]])], limits=(0, 50))
    assert np.unique(levels_shown(axes[0])).tolist() == [0, 255]
    assert np.unique(levels_shown(axes[1])).tolist() == [0, 128]
    bar = figure.axes[-1]
    assert bar.get_ylim() == (0, 50)
    assert bar._colorbar.extend == "both"


def test_a_uint8_image_beside_a_signed_one_keeps_its_own_scale():
    figure, axes = draw([np.full((2, 2), 200, np.uint8), np.array([[-4, 4]])])
    assert np.unique(levels_shown(axes[0])).tolist() == [200]
    assert len(figure.axes) == 3


def test_colour_map_shows_an_angle_as_hue():
    _, [axes] = draw(np.array([[-np.pi, 0.0]]), cmap="hsv", limits=(-np.pi, np.pi))
    red, cyan = axes.images[0].get_array()[0, 0], axes.images[0].get_array()[0, -1]
    assert red.tolist() == [255, 0, 0]
    assert cyan[0] < 10 and cyan[1] > 240 and cyan[2] > 230


def test_small_arrays_show_their_numbers_in_a_contrasting_colour():
    array = np.array([[0, 127], [128, 255]], np.uint8)
    _, [axes] = draw(array)
    texts = {text.get_position(): (text.get_text(), text.get_color()) for text in axes.texts}
    assert texts == {
        (0, 0): ("0", "white"),
        (1, 0): ("127", "white"),
        (0, 1): ("128", "black"),
        (1, 1): ("255", "black"),
    }


def test_numbers_of_a_colour_image_are_in_its_own_order():
    _, [axes] = draw(np.array([[[10, 20, 30]]], np.uint8), encoding="rgb8")
    assert axes.texts[0].get_text() == "10\n20\n30"
    assert "r, g, b" in axes.get_xlabel()


def test_numbers_are_drawn_up_to_twelve_by_twelve_and_can_be_switched_off_and_on():
    for size, count in ((12, 144), (13, 0)):
        assert len(draw(np.zeros((size, size), np.uint8))[1][0].texts) == count
    assert not draw(np.zeros((3, 3), np.uint8), numbers=False)[1][0].texts
    assert len(draw(np.zeros((20, 20), np.uint8), numbers=True)[1][0].texts) == 400
    with pytest.raises(ValueError, match=r"at most 24 rows and cols"):
        draw(np.zeros((25, 25), np.uint8), numbers=True)


def test_a_part_keeps_the_pixel_numbers_of_the_whole():
    array = np.arange(10_000, dtype=np.uint16).reshape(100, 100)
    _, [axes] = draw(array, rows=(40, 45), cols=(60, 64))
    assert axes.get_xlim() == (59.5, 63.5)
    assert axes.get_ylim() == (44.5, 39.5)
    assert [text.get_text() for text in axes.texts][:2] == ["4060", "4061"]
    assert axes.texts[0].get_position() == (60, 40)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("col", "row")


def test_pixels_are_squares_of_one_size():
    figure, axes = draw([np.zeros((5, 5), np.uint8), np.zeros((30, 40), np.uint8)])
    figure_size = figure.get_size_inches() * 100
    for subplot, shape in zip(axes, [(5, 5), (30, 40)], strict=True):
        box = subplot.get_position()
        width = box.width * figure_size[0] / shape[1]
        height = box.height * figure_size[1] / shape[0]
        assert width == pytest.approx(height)
        assert width == pytest.approx(round(width))


@pytest.mark.parametrize("col", range(640, 644))
def test_a_shrunk_image_averages_so_that_thin_lines_stay(col):
    array = np.zeros((720, 1280), np.uint8)
    array[:, col] = 255
    _, [axes] = draw(array)
    assert (levels_shown(axes).max(axis=1) > 60).all()


def test_many_images_wrap_into_lines_that_fit_a_page():
    figure, axes = draw([np.zeros((12, 12), np.uint8)] * 7)
    assert len(axes) == 7
    assert figure.get_size_inches()[0] * 100 <= figures.FIGURE_WIDTH
    boxes = [subplot.get_position() for subplot in axes]
    for k, box in enumerate(boxes):
        assert box.x0 >= 0 and box.x1 <= 1 and box.y0 >= 0 and box.y1 <= 1
        assert not any(box.overlaps(later_box) for later_box in boxes[k + 1 :])


def test_alt_caption_and_text_are_in_the_output(shown):
    show(np.zeros((3, 3), np.uint8), alt='nine "black" pixels', caption="All < 1.")
    bundle = shown[0]._repr_mimebundle_()
    assert 'alt="nine &quot;black&quot; pixels"' in bundle["text/html"]
    assert "All &lt; 1.</figcaption>" in bundle["text/html"]
    assert bundle["text/plain"] == repr(shown[0]) == "All < 1."


@pytest.fixture
def texts(tmp_path, monkeypatch):
    """A current folder with the texts of a lesson; returns their file."""
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "texts" / "arrays.json"
    file.parent.mkdir()
    file.write_text('{"nine": {"caption": "All < 1.", "alt": "nine black pixels"}}')
    return file


def test_both_texts_are_read_in_the_file_of_a_lesson(shown, texts):
    show(np.zeros((3, 3), np.uint8), text="arrays/nine")
    assert alt_text(shown[0]) == "nine black pixels" and shown[0].text == "All < 1."


def test_texts_that_are_not_in_the_current_folder_are_those_of_the_course(shown, texts):
    show(np.zeros((3, 3), np.uint8), text="arrays/tiny")
    assert shown[0].text.startswith("The same array as an image")


@pytest.mark.parametrize("damage", [None, "{", "[]", '{"no": 3}', '{"no": {"caption": "A."}}'])
@pytest.mark.parametrize("name", ["no/no", "arrays/no", "no", ""])
def test_without_its_texts_a_figure_has_its_title(shown, texts, name, damage):
    texts.write_text(damage) if damage else texts.unlink()
    show(np.zeros((3, 3), np.uint8), "zeros", text=name)
    assert (alt_text(shown[0]), "figcaption" in shown[0].html) == ("zeros (gray, 3 rows by 3 cols)", False)
    figure, axes = plt.subplots()
    show_figure(figure, text=name)
    figure.suptitle("Errors")
    axes.set_title("in pixels")
    show_figure(figure, text=name)
    assert [alt_text(output) for output in shown[1:]] == ["a figure", "Errors; in pixels"]


def test_a_text_that_is_no_name_or_given_twice_is_refused():
    with pytest.raises(ValueError, match=r'text must be "lesson/name", got .* caption= and alt='):
        show(np.zeros((3, 3), np.uint8), text=("All < 1.", "nine black pixels"))
    with pytest.raises(ValueError, match="or caption= and alt=, not both"):
        show(np.zeros((3, 3), np.uint8), text="arrays/nine", alt="pixels")


def test_without_alt_it_is_made_of_titles_and_sizes(shown):
    show({"frame": RED_BGR, "gray": np.zeros((4, 6), np.uint8)})
    assert alt_text(shown[0]) == "frame (colour, 4 rows by 4 cols); gray (gray, 4 rows by 6 cols)"


def test_the_same_image_gives_the_same_bytes_under_any_matplotlib_style(shown):
    array = np.random.default_rng(1).integers(0, 256, (200, 300, 3), np.uint8)
    show(array, "noise", caption="Noise.")
    with mpl.rc_context({"axes.facecolor": "black", "font.size": 20, "figure.dpi": 50, "text.color": "red"}):
        show(array, "noise", caption="Noise.")
    show(array.copy(), "noise", caption="Noise.")
    assert shown[0].html == shown[1].html == shown[2].html


@pytest.mark.parametrize("cells", [40, 120, 320, 1280])
def test_a_figure_is_stored_as_the_smallest_png_unless_a_jpeg_is_smaller(shown, cells):
    noise = np.random.default_rng(2).integers(0, 256, (cells * 9 // 16, cells, 3), np.uint8)
    figure, _ = draw(cv2.resize(noise, (1280, 720), interpolation=cv2.INTER_NEAREST))
    show_figure(figure, alt="noise")
    kind, stored = re.search(r"data:image/(\w+);base64,([\w+/=]+)", shown[0].html).groups()
    bgr = cv2.cvtColor(np.asarray(figure.canvas.buffer_rgba()), cv2.COLOR_RGBA2BGR)
    png = cv2.imencode(".png", bgr, [cv2.IMWRITE_PNG_COMPRESSION, 9])[1]
    jpeg = cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, 88, cv2.IMWRITE_JPEG_OPTIMIZE, 1])[1]
    expected = ("png", png) if png.size <= 100_000 or png.size < jpeg.size else ("jpeg", jpeg)
    assert (kind, base64.b64decode(stored)) == (expected[0], expected[1].tobytes())


def test_the_input_does_not_change(shown):
    array = np.random.default_rng(1).integers(0, 256, (30, 30, 3), np.uint8)
    array.flags.writeable = False
    original = array.copy()
    show(array[::-1, ::2])
    assert (array == original).all()


def test_no_figure_stays_open(shown):
    open_before = plt.get_fignums()  # of other tests of this process
    show(np.zeros((3, 3), np.uint8))
    figure, axes = plt.subplots()
    axes.plot([0, 1])
    show_figure(figure, alt="a line", caption="A line.")
    assert plt.get_fignums() == open_before
    assert len(shown) == 2


def test_show_figure_requires_an_alternative_text():
    with pytest.raises(ValueError, match="alt must say in words"):
        show_figure(draw(RED_BGR)[0], alt=" ")


GRAY = np.zeros((4, 4), np.uint8)


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (
            {"images": RED_BGR, "encoding": "mono8"},
            r"shape \(4, 4, 3\), but encoding 'mono8' means \(rows, cols\)",
        ),
        ({"images": RED_BGR, "encoding": "bgra8"}, r'means \(rows, cols, 4\); try encoding="bgr8"'),
        ({"images": np.zeros((4, 4, 2), np.uint8)}, r"try array\[:, :, k\] for one channel"),
        ({"images": GRAY, "encoding": "mono16"}, "dtype uint8, but encoding 'mono16' means uint16"),
        ({"images": RED_BGR.astype(float)}, r"values 0 to 255; expected 0\.\.1: divide by 255"),
        ({"images": RED_BGR.astype(np.int32)}, r"colour image of dtype int32; expected uint8.*np\.clip"),
        ({"images": np.array([[0.0, np.nan]])}, r"contains NaN or infinity.*np\.nan_to_num"),
        ({"images": GRAY.astype(complex)}, "dtype complex128; expected numbers"),
        ({"images": GRAY[0]}, r"shape \(4,\); expected \(rows, cols\)"),
        ({"images": []}, "nothing to show"),
        ({"images": None}, "nothing to show: expected an array or a list of them, got NoneType"),
        ({"images": [[1, 2], [3, 4]]}, r"image 0 is list, not an array; .*np\.array"),
        ({"images": [GRAY, GRAY], "titles": ["one"]}, "1 titles for 2 images"),
        ({"images": [GRAY, GRAY], "encoding": ["mono8"]}, "1 encodings for 2 images"),
        ({"images": {"a": GRAY}, "titles": ["b"]}, "the keys of a dict are the titles"),
        ({"images": GRAY, "encoding": "bayer_rggb8"}, "has encoding 'bayer_rggb8'.*convert it first"),
        ({"images": GRAY, "limits": (5, 5)}, r"limits=\(5, 5\): the value shown black must be below"),
        ({"images": GRAY, "rows": (2, 9)}, r"rows=\(2, 9\) is not inside the image: .*within 0\.\.4"),
        ({"images": GRAY, "columns": 0}, "columns=0: a line has at least one"),
    ],
)
def test_what_cannot_be_shown_is_an_error_that_names_the_remedy(arguments, error):
    with pytest.raises(ValueError, match=error):
        draw(**arguments)


def test_the_images_of_a_line_are_stored_one_by_one(shown):
    levels = [np.full((3, 3), level, np.uint8) for level in (0, 100, 250, 30, 60)]
    show(levels, alt="five levels", columns=3)
    lines = shown[0].html.split("<div ")[1:]
    assert [line.count("<img") for line in lines] == [3, 2]
    assert re.findall(r'alt="([^"]*)"', shown[0].html) == ["five levels", *["continued"] * 4]
    images = [stored_image(tag) for tag in shown[0].html.split("<img")[1:]]
    # In the middle of each image, right of its number, is the level of its pixels.
    assert [image[83, 100, 0] for image in images] == [0, 100, 250, 30, 60]
    assert {image.shape[0] for image in images} == {312}  # 1.5 times 28 + 3 × 46 + 42


def test_one_image_and_its_overlay_stay_one_image(shown):
    figure, axes = draw(np.zeros((3, 3), np.uint8))
    axes[0].annotate("", (0, 0), (2, 2), arrowprops={"color": "red"})
    show_figure(figure, alt="an arrow")
    assert shown[0].html.count("<img") == 1
    assert "flex" not in shown[0].html
