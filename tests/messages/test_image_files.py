"""Every file format that OpenCV writes: there and back, damaged files, headers that claim too much."""

import struct
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from imgproc_course.messages import ConversionError, compressed_to_array
from imgproc_course.messages.cv_bridge import CvBridge, CvBridgeError
from imgproc_course.messages.image_files import FILE_EXTENSIONS

BRIDGE = CvBridge()
RNG = np.random.default_rng(3)
GRAY = RNG.integers(0, 256, (70, 90), np.uint8)
BGR = RNG.integers(0, 256, (70, 90, 3), np.uint8)
BGRA = RNG.integers(0, 256, (70, 90, 4), np.uint8)
GRAY16 = RNG.integers(0, 65536, (70, 90), np.uint16)
BGR16 = RNG.integers(0, 65536, (70, 90, 3), np.uint16)
METERS = RNG.random((70, 90), np.float32)
LOSSLESS = {
    "png": (GRAY, BGR, BGRA, GRAY16, BGR16),
    "bmp": (GRAY, BGR, BGRA),
    "dib": (GRAY, BGR, BGRA),
    "sr": (GRAY, BGR),
    "ras": (GRAY, BGR),
    "tif": (GRAY, BGR, BGRA, GRAY16, BGR16, METERS, GRAY.astype(np.int32), METERS.astype(np.float64)),
    "tiff": (GRAY, BGR, BGRA, GRAY16, BGR16, METERS, GRAY.astype(np.int16), METERS.astype(np.float64)),
    "pbm": (np.where(GRAY > 99, np.uint8(255), np.uint8(0)),),
    "pgm": (GRAY, GRAY16),
    "ppm": (BGR, BGR16),
    "pnm": (GRAY, BGR, GRAY16, BGR16),
    "pfm": (METERS, METERS[..., None].repeat(3, axis=2)),
    "webp": (BGR,),
    "pam": (GRAY, BGR),
}


def file_of(extension, array, *options):
    return cv2.imencode(f".{extension}", array, options)[1].tobytes()


def decoded(data, format=""):
    return compressed_to_array(SimpleNamespace(format=format, data=data))


@pytest.mark.parametrize("extension", ["jpg", "jpeg", "jpe", "png", "bmp", "dib", "sr", "ras", "tif", "tiff"])
@pytest.mark.parametrize("channels", [None, 1, 3])
def test_an_image_of_any_size_comes_back_with_its_shape_and_dtype(extension, channels):
    for height, width in [(100, 100), (100, 700), (300, 500), (700, 100), (700, 700)]:
        shape = (height, width) if channels is None else (height, width, channels)
        ramp = np.arange(np.prod(shape), dtype=np.int64).reshape(shape) // 50
        original = ramp.astype(np.uint8)
        msg = BRIDGE.cv2_to_compressed_imgmsg(original, extension)
        result = BRIDGE.compressed_imgmsg_to_cv2(msg)
        assert msg.format == extension
        assert (result.shape, result.dtype) == (original.squeeze().shape, np.uint8)
        if not extension.startswith("jp"):
            assert (result == original.squeeze()).all()


@pytest.mark.parametrize("extension", LOSSLESS)
def test_formats_without_loss_keep_every_value(extension):
    for original in LOSSLESS[extension]:
        msg = BRIDGE.cv2_to_compressed_imgmsg(original, extension)
        result = BRIDGE.compressed_imgmsg_to_cv2(msg)
        assert result.dtype == original.dtype and np.array_equal(result, original)
        swapped = original.astype(original.dtype.newbyteorder(">"))
        assert bytes(BRIDGE.cv2_to_compressed_imgmsg(swapped, extension).data) == bytes(msg.data)


def test_jpeg_2000_comes_back_nearly_equal():
    smooth = cv2.GaussianBlur(BGR, (15, 15), 5)
    for original in (smooth, smooth[..., 0], smooth.astype(np.uint16) * 257):
        result = BRIDGE.compressed_imgmsg_to_cv2(BRIDGE.cv2_to_compressed_imgmsg(original, "jp2"))
        assert (result.shape, result.dtype) == (original.shape, original.dtype)
        assert np.abs(result.astype(int) - original).max() <= 0.01 * np.iinfo(original.dtype).max
    with pytest.raises(CvBridgeError, match="JPEG 2000 needs at least 32"):
        BRIDGE.cv2_to_compressed_imgmsg(BGR[:16], "jp2")


def test_radiance_hdr_comes_back_nearly_equal():
    bgr = METERS[..., None] * np.float32([0.5, 1.0, 2.0])
    for extension in ("hdr", "pic"):
        result = BRIDGE.compressed_imgmsg_to_cv2(BRIDGE.cv2_to_compressed_imgmsg(bgr, extension))
        assert result.dtype == np.float32 and np.abs(result - bgr).max() <= 0.01


def test_gif_keeps_a_few_colors_nearly():
    bgr = np.zeros((70, 90, 3), np.uint8)
    bgr[:30], bgr[30:, :40] = (255, 0, 0), (0, 255, 255)
    result = BRIDGE.compressed_imgmsg_to_cv2(BRIDGE.cv2_to_compressed_imgmsg(bgr, "gif"))
    assert result.shape[:2] == (70, 90) and np.abs(result[..., :3].astype(int) - bgr).max() <= 80


def test_alpha_and_gray_in_formats_that_do_not_hold_them():
    for extension in ("jpg", "sr"):
        result = BRIDGE.compressed_imgmsg_to_cv2(BRIDGE.cv2_to_compressed_imgmsg(BGRA, extension))
        assert result.shape == (70, 90, 3)
    webp = BRIDGE.compressed_imgmsg_to_cv2(BRIDGE.cv2_to_compressed_imgmsg(GRAY, "webp"))
    assert webp.shape == (70, 90, 3) and (webp == GRAY[..., None]).all()


@pytest.mark.parametrize(
    ("array", "extension", "words"),
    [
        (GRAY16, "jpg", "jpg holds 1, 3 or 4 channels of uint8, not 1 of uint16; 'png' holds 8 and 16 bits"),
        (METERS, "png", "'tiff' holds every dtype"),
        (METERS[..., None].repeat(4, axis=2), "png", "'tiff' holds every dtype"),
        (BGR / 255, "jpg", "call np.clip(np.rint(np.nan_to_num(array) * 255), 0, 255).astype('uint8')"),
        (BGR, "pgm", "pgm holds 1 channels"),
        (BGR[..., :2], "bmp", "convert it to 1, 3 or 4 channels"),
        (BGR, "avif", "got 'avif'"),
        (BGR, "exr", "got 'exr'"),
        (BGR, "", "expected one of the formats jpg, jpeg, jpe"),
        (BGR[:0], "png", "expected 1 to"),
        (np.zeros((70_000, 1), np.uint8), "jpg", "65500 rows"),
    ],
)
def test_what_a_format_cannot_hold_is_refused(array, extension, words):
    with pytest.raises(CvBridgeError) as caught:
        BRIDGE.cv2_to_compressed_imgmsg(array, extension)
    assert words in str(caught.value)


def test_a_depth_image_in_a_tiff_keeps_its_meters():
    msg = BRIDGE.cv2_to_compressed_imgmsg(METERS, "tiff")
    msg.format = "32FC1; tiff compressed "
    assert np.array_equal(BRIDGE.compressed_imgmsg_to_cv2(msg, "32FC1"), METERS)


# --- headers that claim more than the file holds


def patched(extension, array, at, layout, *numbers):
    data = bytearray(file_of(extension, array))
    struct.pack_into(layout, data, at, *numbers)
    return bytes(data)


def tiff_with(tag, value, new_tag=None):
    """A TIFF in which one field of the directory says something else, or is another one."""
    data = bytearray(file_of("tif", BGR))
    (at,) = struct.unpack_from("<I", data, 4)
    (entries,) = struct.unpack_from("<H", data, at)
    for place in range(at + 2, at + 2 + 12 * entries, 12):
        if struct.unpack_from("<H", data, place)[0] == tag:
            struct.pack_into("<HHII", data, place, new_tag or tag, 4, 1, value)
    return bytes(data)


def jp2_with(marker, offset, layout, *numbers):
    data = bytearray(file_of("jp2", BGR))
    struct.pack_into(layout, data, data.index(marker) + offset, *numbers)
    return bytes(data)


HUGE = 2**31 - 1
LIES = {
    "bmp of 4 exabytes": (patched("bmp", BGR, 18, "<ii", HUGE, HUGE), "accepted from so many bytes"),
    "bmp upside down of many rows": (patched("bmp", BGR, 22, "<i", -HUGE), "accepted from so many bytes"),
    "bmp without rows": (patched("bmp", BGR, 22, "<i", 0), "has no pixel"),
    "bmp, run lengths": (patched("bmp", BGR, 30, "<I", 1), "damaged or compressed"),
    "bmp cut": (file_of("bmp", BGR)[:30], "without a readable header"),
    "sun raster": (patched("sr", BGR, 4, ">II", HUGE, HUGE), "accepted from so many bytes"),
    "sun raster, run lengths": (patched("sr", BGR, 20, ">I", 2), "damaged or compressed"),
    "tiff": (tiff_with(256, HUGE), "accepted from so many bytes"),
    "tiff of CMYK": (tiff_with(262, 5), "of another kind"),
    "tiff of planes": (tiff_with(284, 2), "of another kind"),
    "tiff of tiles": (tiff_with(278, 16, 322), "of another kind"),
    "tiff without width": (
        file_of("tif", BGR).replace(b"\0\1\3\0\1", b"\1\1\3\0\1"),
        "without a readable header",
    ),
    "tiff cut": (file_of("tif", BGR)[:60], "without a readable header"),
    "big tiff": (b"II+\0" + bytes(60), "holds BigTIFF"),
    "ppm": (b"P6\n999999999 999999999\n255\n" + bytes(60), "accepted from so many bytes"),
    "ppm, comments": (b"P6 # x\n# y\n9999 # z\n9999\n255\n" + bytes(60), "accepted from so many bytes"),
    "pbm": (b"P4\n800 800\n" + bytes(799), "accepted from so many bytes"),
    "pgm without numbers": (b"P5 many rows", "without a readable header"),
    "pfm": (b"PF\n99999 99999\n-1.0\n" + bytes(60), "accepted from so many bytes"),
    "pfm without numbers": (b"Pf\n\n\n", "without a readable header"),
    "webp": (patched("webp", BGR, 21, "<I", 0x0FFFFFFF), "accepted from so many bytes"),
    "webp of another kind": (b"RIFF\0\0\0\0WEBPVP9 " + bytes(60), "without a readable header"),
    "pam": (
        b"P7\nWIDTH 9999\nHEIGHT 9999\nDEPTH 3\nMAXVAL 255\nENDHDR\n" + bytes(60),
        "accepted from so many bytes",
    ),
    "pam without numbers": (b"P7\nWIDTH 2\n", "without a readable header"),
    "hdr": (
        b"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9999 +X 9999\n" + bytes(60),
        "accepted from so many bytes",
    ),
    "hdr without numbers": (b"#?RADIANCE\n\n\n", "without a readable header"),
    "gif": (b"GIF89a" + bytes([255]) * 60, "accepted from so many bytes"),
    "gif cut": (b"GIF89a", "without a readable header"),
    "webp, animated": (b"RIFF\0\0\0\0WEBPVP8X\x0a\0\0\0\x02" + bytes(60), "animated"),
    "jp2 of many pixels": (
        jp2_with(b"\xff\x51", 6, ">8I", HUGE, HUGE, 0, 0, HUGE, HUGE, 0, 0),
        "accepted from so many bytes",
    ),
    "jp2 of many tiles": (jp2_with(b"\xff\x51", 22, ">II", 1, 1), "one tile"),
    "jp2 with precincts": (jp2_with(b"\xff\x52", 4, ">B", 1), "one tile"),
    "jp2 of many layers": (jp2_with(b"\xff\x52", 6, ">H", 65535), "one tile"),
    "jp2 cut": (file_of("jp2", BGR)[:90], "without a readable header"),
    "avif": (b"\0\0\0\x20ftypavif" + bytes(60), "holds AVIF"),
}


@pytest.mark.parametrize("case", LIES)
def test_a_header_that_lies_is_refused_before_decoding(case, monkeypatch):
    data, words = LIES[case]
    monkeypatch.setattr(cv2, "imdecode", lambda *_: pytest.fail("OpenCV must not see this file"))
    with pytest.raises(ConversionError) as caught:
        decoded(data)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    "data",
    [
        *(file_of(extension, BGR)[:-1] for extension in ("bmp", "sr", "ppm", "pam", "gif")),
        file_of("pfm", METERS)[:-1],
        file_of("hdr", METERS[..., None].repeat(3, axis=2))[:-1],
        b"P4\n80 80\n" + bytes(799),
        tiff_with(278, HUGE),  # one strip for all rows, which is shorter than they are
        tiff_with(277, 9),  # channels
        tiff_with(259, 7),  # JPEG inside
    ],
)
def test_a_file_whose_pixels_do_not_fit_its_header_is_refused(data):
    with pytest.raises(ConversionError, match="do not decode"):
        decoded(data)


@pytest.mark.parametrize("extension", sorted(set(FILE_EXTENSIONS) - {"jpg", "jpeg", "jpe"}))
def test_a_file_that_is_cut_short_is_refused_or_keeps_its_size(extension):
    """Some decoders return what they have; the size in the header stays."""
    original = next(iter(LOSSLESS.get(extension, (BGR,))))
    whole = file_of(extension, original)
    for length in (*range(0, len(whole), max(1, len(whole) // 60)), len(whole) - 1):
        try:
            result = decoded(whole[:length])
        except ConversionError:
            continue
        assert result.shape == original.shape


@pytest.mark.parametrize("extension", ["bmp", "tif", "ppm", "webp", "jp2"])
def test_blank_images_of_two_megapixels_are_accepted(extension):
    blank = np.zeros((1080, 1920, 3), np.uint8)
    assert not BRIDGE.compressed_imgmsg_to_cv2(BRIDGE.cv2_to_compressed_imgmsg(blank, extension)).any()
