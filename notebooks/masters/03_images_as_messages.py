# ---
# jupyter:
#   imgproc_course:
#     title: Images as messages
# ---

# %% [markdown]
# # Images as messages
#
# A robot's camera sends *messages*. A message with an image has a few fields that describe the image, and one long sequence of bytes. (A *[[term:byte]]* is a number from 0 to 255.) The fields say how to read the bytes.
#
# **You will be able to**
# - name the fields of a `sensor_msgs/Image`, ROS's message type for images,
# - make an array from the bytes of a message,
# - recognise and repair two mistakes: channels in the wrong order, rows cut wrongly,
# - deeper: choose the policies of a [[term:subscription]] to a camera.
#
# **Time** [[minutes]]. **You need** [[arrays]]: shape, dtype, slices with a step, `astype`.

# %%
import cv2
import numpy as np

from imgproc_course.display import show
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.messages import (
    array_to_compressed, array_to_image, compressed_to_array,
    encoding_info, image_to_array)
from imgproc_course.messages.cv_bridge import CvBridge
from imgproc_course.recording import open_recording
from imgproc_course.ros import ImageSubscriber, open_camera, ros_available

# %% role="texts"
figure_texts = {
    "tiny": (
        "The first row holds 10, 11, 12 and so on, the second row 20, 21, 22. So you can see at once if the rows are cut wrongly.",
        "A five by five grid of gray squares with the numbers 10 to 54 in them.",
    ),
    "decoded": (
        "The first frame of the drive: two lines of NumPy decoded it from 2,764,800 bytes.",
        "A living room seen from close to the floor, with a red and white ball ahead.",
    ),
    "swapped": (
        "The same bytes shown twice: read as bgr8, the red ball turns blue, and so does the wooden floor.",
        "Two copies of the living room. In the second one everything red is blue.",
    ),
    "cut": (
        "On the left, padding (99) is read as pixels. Each row is shifted by three more pixels than the row above: the image is sheared.",
        "Two five by five grids of numbers: the left one has 99 in several places, the right one has the numbers 10 to 54.",
    ),
    "sheared": (
        "Each row is shifted by one more pixel than the row above it, so vertical edges become diagonal.",
        "The living room, slanted; what leaves the image on one side comes in again on the other side.",
    ),
    "circle": (
        "The circle is on the copy. The message still holds the camera's image.",
        "The red and white ball with a yellow circle around it.",
    ),
}

# %% [markdown]
# ## 1 · An image is a message ([[minutes]])
#
# We put the first frame of the drive into a message, as the robot does.

# %%
recording = open_recording("drive")
header = recording.message(0).header
message = array_to_image(recording.frame(0, encoding="rgb8"), "rgb8", header)

print("height      ", message.height)
print("width       ", message.width)
print("encoding    ", message.encoding)
print("is_bigendian", message.is_bigendian)
print("step        ", message.step)
print("data         the first six bytes:", list(message.data[:6]))

# %% [markdown]
# - `height`, `width`: rows and columns of the image, in pixels.
# - `encoding`: the channels of a pixel and their type. `rgb8` is red, green and blue, one byte (8 bits) each.
# - `step`: number of bytes per row in `data`.
# - `is_bigendian`: for numbers of two or more bytes (section 5).
# - `data`: all rows, one after the other.
# - `header`: when the image was taken, and by which camera (section 8).
#
# **Predict.** How many bytes are in `data`?

# %% role="predict"
guess_bytes = None  # your guess: how many bytes?

# %%
bytes_per_pixel = 3
total_bytes = message.height * message.width * bytes_per_pixel
print("calculated:", total_bytes)
compare_guess(guess_bytes, len(message.data))

# %%
# Check: the numbers in this section
assert total_bytes == len(message.data) == 2_764_800
assert message.step == message.width * bytes_per_pixel == 3840

# %% [markdown]
# ## 2 · Find a pixel by hand ([[minutes]])
#
# At which position in `data` is the pixel of row 1, column 2? The [[term:encoding]] of this small image is `mono8`: one channel, one byte per pixel. The value of such a pixel is its *intensity* or *gray level*: 0 is black and 255 is white.

# %%
tiny = np.array([[10, 11, 12, 13, 14],
                 [20, 21, 22, 23, 24],
                 [30, 31, 32, 33, 34],
                 [40, 41, 42, 43, 44],
                 [50, 51, 52, 53, 54]], dtype=np.uint8)
tiny_message = array_to_image(tiny, "mono8")
print("step", tiny_message.step)
print("data", list(tiny_message.data))

# %%
show(tiny, "data, in rows of step = 5 bytes", encoding="mono8",
     text="images_as_messages/tiny")

# %% [markdown]
# Rows, columns and bytes are counted from 0. Row 1 begins at byte `1 * step`:
#
# $$\text{position} = \text{row} \cdot \text{step} + \text{column} \cdot \text{bytes per pixel}$$
#
# **Predict.** At which position is the pixel of row 3, column 4?

# %% role="predict"
guess_position = None  # your guess: the position of the byte, counted from 0

# %%
row, column = 3, 4
position = row * tiny_message.step + column * 1  # 1 byte per pixel
print("value there:", tiny_message.data[position])
compare_guess(guess_position, position)

# %% [markdown]
# **All pixels at once.** `np.frombuffer` makes an array of the bytes, without a copy. `reshape` cuts it into rows.

# %%
flat = np.frombuffer(tiny_message.data, dtype=np.uint8)
decoded = flat.reshape(tiny_message.height, tiny_message.width)
print("flat   ", flat.shape, flat.dtype)
print("decoded", decoded.shape, decoded.dtype)
print(decoded)

# %%
# Check: the numbers in this section
assert position == 19 and tiny_message.data[position] == tiny[3, 4] == 44
assert 1 * tiny_message.step + 2 == 7 and tiny_message.data[7] == tiny[1, 2]
assert (decoded == tiny).all()

# %% [markdown]
# ## 3 · Planned failure: which channel is red? ([[minutes]])
#
# The same lines decode the camera's image; `reshape` gets one more number: three channels per pixel.

# %%
flat = np.frombuffer(message.data, dtype=np.uint8)
frame = flat.reshape(message.height, message.width, 3)
print("frame", frame.shape, frame.dtype)
print("range", frame.min(), "to", frame.max())

# %%
show(frame, "decoded by hand", encoding="rgb8", text="images_as_messages/decoded")

# %% [markdown]
# The robot sends red, green, blue. OpenCV needs blue, green, red. You cannot see the order in the bytes: only `encoding` tells it.
#
# **Predict.** The ball ahead is red and white. Which colour will replace the red if a program reads `rgb8` bytes as `bgr8`?

# %% role="predict"
guess_colour = None  # your guess: "blue", "green" or "red"?

# %%
ball = frame[388, 551]
print("a pixel on the ball's red stripe, in the order of data:", ball)
largest = ball.argmax()  # the position of the largest number
compare_guess(guess_colour, ["blue", "green", "red"][largest])

# %%
show([frame, frame], ["correct: read as rgb8", "wrong: read as bgr8"],
     encoding=["rgb8", "bgr8"], text="images_as_messages/swapped")

# %% [markdown]
# Python raised no error. **Repair it**: `image_to_array` reads `encoding`, and reorders the channels if you ask for another.

# %%
bgr = image_to_array(message, "bgr8")
print("rgb8 bytes:", frame[388, 551], "  as bgr8:", bgr[388, 551])

# %%
# Check: the numbers in this section
assert frame.shape == (720, 1280, 3) and total_bytes == 2_764_800
assert largest == 0  # red in rgb8, but the place of blue in bgr8
assert (bgr == frame[..., ::-1]).all()

# %% [markdown]
# ## 4 · Planned failure: a padded row ([[minutes+3]])
#
# Many cameras start every row at a multiple of, for example, 16 bytes, and fill the rest with bytes without a meaning: *[[term:padded rows|padding]]*. This image has five columns, but a step of eight: the last three bytes of each row (here 99) are padding.

# %%
padded_rows = np.full((5, 8), 99, dtype=np.uint8)
padded_rows[:, :5] = tiny  # all rows, the first five columns
print(padded_rows)

# %%
padded = array_to_image(tiny, "mono8")
padded.step = 8
padded.data = padded_rows.tobytes()
print("bytes:", len(padded.data))
print("height × width:", padded.height * padded.width)

# %% [markdown]
# **Predict.** A program ignores `step`, takes the first 25 bytes and cuts them into rows of five. Which number will be in row 1, column 0?

# %% role="predict"
guess_first = None  # your guess: which number?

# %%
flat = np.frombuffer(padded.data, dtype=np.uint8)
cut_by_width = flat[:25].reshape(5, 5)
compare_guess(guess_first, cut_by_width[1, 0])

# %% [markdown]
# The correct way: first cut the bytes into rows of `step` bytes. Then crop the padding: keep only the first `width` columns.

# %%
rows = flat.reshape(padded.height, padded.step)
cut_by_step = rows[:, : padded.width]
show([cut_by_width, cut_by_step], ["cut by width", "cut by step, then cropped"],
     encoding="mono8", text="images_as_messages/cut")

# %%
# Check: the numbers in this section
assert len(padded.data) == 40 and cut_by_width[1, 0] == 99
assert (cut_by_step == tiny).all() and (image_to_array(padded) == tiny).all()

# %% [markdown]
# ### Your turn: decode a padded colour image ([[minutes]], practice)
#
# Write `decode_padded(message)`: cut by `step` and crop as in `cut_by_step`, then form the pixels of a colour image as in section 3. `np` is ready to use. The check refuses an answer that uses `cv2` or the course's converter.
#
# | Input | Output | Example call |
# |---|---|---|
# | `message`: encoding `rgb8`, rows with padding of any length | an array of shape (height, width, 3), dtype uint8 (the type counts), without the padding | for a message with height 2, width 4 and step 14, the result has shape (2, 4, 3) |

# %% role="exercise"
from types import SimpleNamespace

exercise(
    "messages-padding",
    title="Remove the padding",
    function="decode_padded",
    exact_type=True,
    practice=True,
    time_limit=5,
    hint="A row has step bytes. The first width * 3 of them are pixels, the rest is padding.",
    hints=(
        "How many bytes does one row have in data? And how many of them are pixels, if a pixel takes three bytes?",
        "Three steps: cut data into rows of step bytes; keep only the first width * 3 bytes of each row; cut these bytes into pixels of three channels.",
        "rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step). Then pixels = rows[:, : message.width * 3]. The last line reshapes pixels to (height, width, 3).",
    ),
    explanation="The order of the steps matters. First the bytes are cut into rows of step bytes, because the padding belongs to the rows. The slice keeps all rows and the first width * 3 bytes of each. Only then can the bytes be cut into pixels: before, the length of a row may not be a multiple of 3.",
    another_way="You can also write a loop over the rows: row r begins at byte r * step, and its pixels are the width * 3 bytes from there.",
)


def padded_message(rng, height, width, padding, *, low=0, padding_byte=None):
    rows = rng.integers(low, 256, size=(height, width * 3 + padding), dtype=np.uint8)
    if padding_byte is not None:
        rows[:, width * 3 :] = padding_byte
    return SimpleNamespace(
        height=height, width=width, encoding="rgb8", is_bigendian=0, step=rows.shape[1], data=rows.tobytes()
    )

# %% role="answer" exercise="messages-padding"
def decode_padded(message):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution" exercise="messages-padding"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    pixels = rows[:, : message.width * 3]
    return pixels.reshape(message.height, message.width, 3)

# %% role="check" exercise="messages-padding"
check("messages-padding", decode_padded)

# %% role="case" exercise="messages-padding" title="one byte of padding, always 99"
def inputs(rng):
    return (padded_message(rng, 3, 5, 1, low=100, padding_byte=99),)

# %% role="case" exercise="messages-padding" title="one byte of padding, any value"
def inputs(rng):
    message = padded_message(rng, 2, 3, 1, padding_byte=255)
    return (SimpleNamespace(**{**vars(message), "data": bytes([99]) + message.data[1:]}),)

# %% role="case" exercise="messages-padding" title="three bytes of padding"
def inputs(rng):
    message = padded_message(rng, 4, 3, 3)
    return (SimpleNamespace(**{**vars(message), "data": bytes([99]) + message.data[1:]}),)

# %% role="case" exercise="messages-padding" title="six bytes of padding, and none"
def inputs(rng):
    message = padded_message(rng, 2, 4, 6)
    message = SimpleNamespace(**{**vars(message), "data": bytes([99]) + message.data[1:]})
    return [(message,), (padded_message(rng, 3, 2, 0),)]

# %% role="hidden" exercise="messages-padding" title="another padding" hint="The number of padding bytes changes from message to message: step tells it."
def inputs(rng):
    height, width = (int(n) for n in rng.integers(2, 7, size=2))
    return (padded_message(rng, height, width + height, int(rng.integers(1, 6))),)

# %% [markdown]
# ### The same mistake in the camera's image ([[minutes]], deeper)
#
# Every row is padded by one pixel (three bytes):

# %%
wide = np.zeros((720, 1281, 3), dtype=np.uint8)
wide[:, :1280] = frame
first_bytes = wide.reshape(-1)[: 720 * 1280 * 3]  # -1: one long row
sheared = first_bytes.reshape(720, 1280, 3)
show(sheared, "padding read as pixels", encoding="rgb8",
     text="images_as_messages/sheared")

# %% [markdown]
# `image_to_array` uses `step`. If the fields of a message contradict each other, it raises an error that says which field is wrong, which value was expected, and what you can do. (`try` and `except` catch the error, so that the lesson goes on.)

# %%
cut_short = array_to_image(tiny, "mono8")
cut_short.data = cut_short.data[:20]  # five bytes are lost
try:
    image_to_array(cut_short)
except ValueError as error:
    print(error)

# %%
# Check: the camera's image with and without the padding
assert (sheared[1, 0] == 0).all() and (sheared[700, 700:] == frame[700, :580]).all()

# %% [markdown]
# ## 5 · Which byte comes first? ([[minutes]], deeper)
#
# A depth camera needs numbers above 255, so a pixel takes two bytes. The encoding is `16UC1` (16 bits, unsigned, 1 channel) or `mono16`. The *more significant* byte counts 256 times as much as the other. *[[term:big-endian|Big-endian]]* stores it first, *little-endian* last.
#
# **Predict.** The bytes are 1 and 2. In big-endian order they mean 1 × 256 + 2 = 258. What do they mean in little-endian order?

# %% role="predict"
guess_little = None  # your guess: which number?

# %%
first, second = 1, 2
print("big-endian:", first * 256 + second)
compare_guess(guess_little, second * 256 + first)

# %% [markdown]
# The field `is_bigendian` gives the order. Here is a message of two rows with two pixels each:

# %%
distances = np.array([[258, 300], [1000, 40000]], dtype=np.uint16)
depth_message = array_to_image(distances, "mono16")
print("is_bigendian", depth_message.is_bigendian, "  step", depth_message.step)
print("data", list(depth_message.data))

# %% [markdown]
# `is_bigendian` is 0, so the less significant byte comes first: 2 + 1 × 256 = 258. The slice `0::2` takes every second column, beginning with column 0: the first byte of each pixel. `1::2` takes the second bytes. 256 does not fit into `uint8`, so widen before you multiply.

# %%
flat = np.frombuffer(depth_message.data, dtype=np.uint8)
rows = flat.reshape(depth_message.height, depth_message.step)
first_bytes = rows[:, 0::2].astype(np.uint16)
second_bytes = rows[:, 1::2].astype(np.uint16)
print(second_bytes * 256 + first_bytes)

# %% [markdown]
# NumPy can do this for you. The dtype `"<u2"` means: little-endian (`<`), unsigned (`u`), 2 bytes. `">u2"` is big-endian.

# %%
little = np.frombuffer(depth_message.data, dtype="<u2").reshape(2, 2)
big = np.frombuffer(depth_message.data, dtype=">u2").reshape(2, 2)
print("read as little-endian:", little.tolist())
print("read as big-endian:   ", big.tolist())

# %% [markdown]
# Nearly every robot sends little-endian numbers, so a program that ignores the field usually works. But with a big-endian message, 258 mm become 513 mm.

# %%
# Check: the numbers in this section
assert 1 * 256 + 2 == 258 and 2 * 256 + 1 == 513
assert (second_bytes * 256 + first_bytes == distances).all()
assert (little == distances).all() and big[0, 0] == 513
depth_message.is_bigendian = 1
assert image_to_array(depth_message)[0, 0] == 513

# %% [markdown]
# ### Your turn: decode 16 bits ([[minutes]], practice, deeper)
#
# Write `decode_mono16(message)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `message`: encoding `mono16`, rows without padding; `is_bigendian` is 0 or 1 | an array of shape (height, width), dtype uint16 (the type counts) | for a message with the bytes 1 and 2, height 1, width 1 and is_bigendian 1, the result is `[[258]]` |

# %% role="exercise"
from types import SimpleNamespace

exercise(
    "messages-mono16",
    title="Decode 16 bits",
    function="decode_mono16",
    exact_type=True,
    practice=True,
    time_limit=5,
    hint="A pixel is the more significant byte × 256 plus the other byte. is_bigendian says which of the two comes first.",
    hints=(
        "A pixel takes two bytes. Which of them counts 256 times as much as the other? Which field tells you?",
        "Cut data into rows of step bytes, and widen them to uint16. The first bytes of all pixels are every second column, beginning with column 0; the second bytes begin with column 1. Combine them in the order that is_bigendian gives.",
        "first = rows[:, 0::2] and second = rows[:, 1::2]. If message.is_bigendian is 1, return first * 256 + second. Otherwise second is the more significant byte.",
    ),
    explanation="The slices 0::2 and 1::2 take every second column: the first and the second byte of each pixel. The bytes are widened to uint16 before the product, because 256 does not fit into uint8. The largest result is 255 * 256 + 255 = 65535, the largest number of uint16.",
    another_way='You can also let NumPy combine the bytes: np.frombuffer(message.data, dtype=">u2") for big-endian, "<u2" for little-endian, and then reshape.',
)


def wide_message(rng, height, width, is_bigendian):
    pixels = rng.integers(0, 65536, size=(height, width))
    pixels[0, 0], pixels[-1, -1] = 40_000, 258
    data = pixels.astype(">u2" if is_bigendian else "<u2").tobytes()
    return SimpleNamespace(
        height=height, width=width, encoding="mono16", is_bigendian=is_bigendian, step=width * 2, data=data
    )

# %% role="answer" exercise="messages-mono16"
def decode_mono16(message):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution" exercise="messages-mono16"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    first = rows[:, 0::2].astype(np.uint16)
    second = rows[:, 1::2].astype(np.uint16)
    if message.is_bigendian:
        return first * 256 + second
    return second * 256 + first


# %% role="check" exercise="messages-mono16"
check("messages-mono16", decode_mono16)

# %% role="case" exercise="messages-mono16" title="big-endian"
def inputs(rng):
    return (wide_message(rng, 2, 5, 1),)

# %% role="case" exercise="messages-mono16" title="little-endian"
def inputs(rng):
    return (wide_message(rng, 4, 3, 0),)

# %% role="hidden" exercise="messages-mono16" title="both byte orders, another size"
def inputs(rng):
    height, width = (int(n) for n in rng.integers(2, 7, size=2))
    return [(wide_message(rng, height, width + height, order),) for order in (0, 1)]


# %% [markdown]
# ## 6 · Use the library ([[minutes]])
#
# **Pause?** Afterwards choose **Run → Run All Above Selected Cell**.
#
# ROS 2 has its own converter, `cv_bridge`. The course's `CvBridge` has the same methods and, for correct messages, the same results: on a robot you only change the import. (`cv_bridge` from pip is for ROS 1.)
#
# **Check** that three ways give the same array. ("passthrough": keep the encoding of the message.)

# %%
by_hand = frame
by_function = image_to_array(message)
by_bridge = CvBridge().imgmsg_to_cv2(message, desired_encoding="passthrough")
print("values that differ:", (by_hand != by_function).sum(),
      (by_hand != by_bridge).sum())

# %% [markdown]
# The other direction is `cv2_to_imgmsg`: it makes a message from an array.

# %%
new_message = CvBridge().cv2_to_imgmsg(tiny, encoding="mono8")
print(new_message.height, new_message.width,
      new_message.encoding, new_message.step)

# %%
# Check: the results in this section
assert (by_hand == by_function).all() and (by_hand == by_bridge).all()
assert list(new_message.data) == list(tiny_message.data)

# %% [markdown]
# ### A view is not a copy ([[minutes]], deeper)
#
# If no value has to change, `image_to_array` does not copy the bytes. Its array is a *view* of the memory of the message, and read-only: if you drew into it, you would change the message. To draw, make a copy.

# %%
print("writeable:", by_function.flags.writeable)
canvas = by_function.copy()
yellow = (255, 255, 0)
cv2.circle(canvas, (546, 380), 40, yellow, thickness=4)  # OpenCV: (column, row)
show(canvas, "a circle on a copy", encoding="rgb8",
     rows=(310, 450), cols=(446, 646), text="images_as_messages/circle")

# %% [markdown]
# Every encoding has a dtype and a number of channels (`32FC1`: 32-bit floating-point numbers, 1 channel):

# %%
for name in ("mono8", "rgb8", "bgra8", "16UC1", "32FC1"):
    info = encoding_info(name)
    print(name, " dtype:", info.dtype, " channels:", info.channels)

# %%
# Check: views and encodings
assert not by_function.flags.writeable and (image_to_array(message) == frame).all()
assert encoding_info("rgb8").channels == 3 and encoding_info("16UC1").dtype == np.uint16
assert encoding_info("32FC1").dtype == np.float32

# %% [markdown]
# ## 7 · Your turn: decode a message ([[minutes]], deeper)
#
# Write `decode(message)`. It decodes four encodings, and every message may have padded rows.
#
# | Input | Output | Example call |
# |---|---|---|
# | `message`: an object with the fields `height`, `width`, `encoding`, `is_bigendian`, `step` and `data` | the pixels, an array; its shape and dtype depend on the encoding (the types count) | `decode(padded)` equals `tiny` |
#
# - `mono8`: shape (height, width), dtype uint8
# - `rgb8` and `bgr8`: shape (height, width, 3), dtype uint8, with the channels in the same order as in `data`
# - `mono16`: shape (height, width), dtype uint16; `is_bigendian` gives the byte order in `data`
#
# Use only NumPy. Begin as in `decode_padded`, with rows of `step` bytes, for every encoding.

# %% role="exercise"
from types import SimpleNamespace

exercise(
    "messages-decode",
    title="Decode a message by hand",
    function="decode",
    exact_type=True,
    time_limit=5,
    hint="First cut data into rows of step bytes. Then crop the padding at the end of each row. Then convert the remaining bytes to pixels.",
    hints=(
        "Which step is the same for all four encodings? And how many bytes does a pixel take in each of them?",
        "Begin with rows of step bytes, for every encoding. Then ask message.encoding: mono8 keeps width bytes of each row; rgb8 and bgr8 keep width * 3 bytes and reshape to (height, width, 3); mono16 keeps width * 2 bytes and combines two bytes to one number, as in the exercise with 16 bits.",
        'rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step). Then if message.encoding == "mono8": return rows[:, : message.width]. Then if message.encoding in ("rgb8", "bgr8"): crop at width * 3, reshape, return. The rest is mono16: pixels = rows[:, : message.width * 2].astype(np.uint16), first = pixels[:, 0::2], second = pixels[:, 1::2], and is_bigendian decides which of them is multiplied by 256.',
    ),
    explanation="The rows come first: the padding belongs to the rows, so every encoding begins with reshape(height, step). The number of bytes that are kept is width × bytes per pixel. Only for mono16 the bytes are changed: two bytes become one number. They are widened to uint16 before that, because 256 does not fit into uint8.",
    another_way='You can also convert the cropped bytes of mono16 with pixels.copy().view(">u2") or view("<u2"): a view reads the same bytes as numbers of two bytes.',
)


def make_message(rng, encoding, channels, padding, *, dtype="u1", is_bigendian=0):
    height, width = (int(n) for n in rng.integers(2, 6, size=2))
    width += height  # never square, so that exchanged rows and columns are noticed
    pixels = rng.integers(0, 256 if dtype == "u1" else 65536, size=(height, width * channels), dtype=np.uint32)
    order = ">" if is_bigendian else "<"
    rows = pixels.astype(order + dtype).view("u1").reshape(height, -1)
    filled = np.concatenate([rows, np.full((height, padding), 99, "u1")], axis=1)
    return SimpleNamespace(
        height=height, width=width, encoding=encoding, is_bigendian=is_bigendian, step=filled.shape[1], data=filled.tobytes()
    )

# %% role="answer" exercise="messages-decode"
def decode(message):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution" exercise="messages-decode"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, : message.width]
    if message.encoding in ("rgb8", "bgr8"):
        pixels = rows[:, : message.width * 3]
        return pixels.reshape(message.height, message.width, 3)
    pixels = rows[:, : message.width * 2].astype(np.uint16)
    first = pixels[:, 0::2]
    second = pixels[:, 1::2]
    if message.is_bigendian:
        return first * 256 + second
    return second * 256 + first


# %% role="check" exercise="messages-decode"
check("messages-decode", decode)

# %% role="case" exercise="messages-decode" title="a colour image without padding" points=1
def inputs(rng):
    return (make_message(rng, "rgb8", 3, 0),)

# %% role="case" exercise="messages-decode" title="a colour image with padded rows" points=1
def inputs(rng):
    return (make_message(rng, "bgr8", 3, int(rng.integers(1, 6)), is_bigendian=1),)

# %% role="case" exercise="messages-decode" title="a gray image with padded rows" points=1
def inputs(rng):
    return (make_message(rng, "mono8", 1, int(rng.integers(9, 12))),)

# %% role="case" exercise="messages-decode" title="16 bits, big-endian" points=1
def inputs(rng):
    return (make_message(rng, "mono16", 1, 3, dtype="u2", is_bigendian=1),)

# %% role="case" exercise="messages-decode" title="16 bits, little-endian" points=1
def inputs(rng):
    return (make_message(rng, "mono16", 1, 0, dtype="u2"),)

# %% role="hidden" exercise="messages-decode" title="padding that is not a whole pixel" points=1 hint="The padding may be one byte although a pixel has two or three: crop bytes, not pixels."
def inputs(rng):
    return (make_message(rng, "rgb8", 3, 1),)

# %% role="hidden" exercise="messages-decode" title="16 bits, little-endian, padded" points=1 hint="Does your function read the byte order from the message, or does it always use the same?"
def inputs(rng):
    return (make_message(rng, "mono16", 1, 3, dtype="u2"),)

# %% [markdown]
# ## 8 · The header: time and camera ([[minutes]])
#
# `header.stamp` (the *[[term:stamp]]*) is the time when the image was taken. `header.frame_id` names the [[term:coordinate frame]] of the camera. (Here *frame* means a coordinate system.) A *[[term:node]]*, a program that takes part in ROS, copies the header when it publishes a processed image.

# %%
stamps = recording.stamps  # in nanoseconds, one for each frame
print("frame_id:", message.header.frame_id)
print("frames:", len(recording), "  in", (stamps[-1] - stamps[0]) / 1e9, "s")
print("between the first two frames:", (stamps[1] - stamps[0]) / 1e6, "ms")

# %%
# Check: the numbers in this section
assert message.header.frame_id == "camera_front" and len(recording) == 90
assert np.median(np.diff(stamps)) == 100_000_000

# %% [markdown]
# ## 9 · Raw or compressed? ([[minutes]], deeper)
#
# The robot publishes each image twice: raw (not compressed) on the topic `image_raw`, and as a [[term:JPEG]] on the topic `image_raw/compressed`. **Predict** how many times smaller the JPEG is.

# %% role="predict"
guess_smaller = None  # your guess: how many times smaller?

# %%
compressed = recording.message(0)
raw_bytes, jpeg_bytes = len(message.data), len(compressed.data)
print("raw:", raw_bytes, "bytes,", round(raw_bytes * 10 * 8 / 1e6), "Mbit/s")
print("JPEG:", jpeg_bytes, "bytes,", round(jpeg_bytes * 10 * 8 / 1e6), "Mbit/s")
compare_guess(guess_smaller, round(raw_bytes / jpeg_bytes, 1))

# %% [markdown]
# Many Wi-Fi networks cannot carry 221 Mbit/s (millions of bits per second). ROS 2 sends a large message in packets of [[term:UDP]], a network protocol. A UDP packet holds at most 65,507 bytes, so a raw image needs 43 packets, and the JPEG needs three. If one packet is lost, the whole image is lost: cameras do not send it again. So over Wi-Fi, subscribe to the compressed topic. But JPEG changes the pixels a little each time an image is compressed.

# %%
once = compressed_to_array(compressed, "bgr8")
again = compressed_to_array(array_to_compressed(once), "bgr8")
difference = np.abs(once.astype(np.int16) - again)
print("compressed again: mean change",
      round(float(difference.mean()), 2), "gray levels")

# %%
# Check: the numbers in this section
import math

assert jpeg_bytes == 159_329 and round(raw_bytes / jpeg_bytes, 1) == 17.4
assert round(raw_bytes * 80 / 1e6) == 221 and round(jpeg_bytes * 80 / 1e6) == 13
assert math.ceil(raw_bytes / 65_507) == 43 and math.ceil(jpeg_bytes / 65_507) == 3
assert 0 < difference.mean() < 2

# %% [markdown]
# ## 10 · A live topic and its QoS ([[minutes]])
#
# Now the recorded drive is published on the robot's own topic, and this notebook subscribes to it. (Without ROS, the cells below do nothing.)

# %%
if ros_available():
    camera = open_camera("recording")
    source = ImageSubscriber(camera.topic, encoding="bgr8")
    live_frame = source.wait(timeout=10)
    print(camera.topic, live_frame.shape, live_frame.dtype)

# %%
# Check: what has arrived
assert not ros_available() or camera.topic == "/kachaka/front_camera/image_raw"
assert not ros_available() or live_frame.shape == (720, 1280, 3)
assert not ros_available() or live_frame.dtype == np.uint8

# %% [markdown]
# ### Quality of service ([[minutes]], deeper)
#
# Each [[term:publisher]] and each subscription has policies for the *Quality of Service* ([[term:QoS]]). A camera driver uses these:
#
# - reliability: *[[term:best effort]]*. A lost message is not sent again; the opposite is *[[term:reliable]]*.
# - durability: *[[term:volatile]]*. A late subscription receives no earlier messages.
# - history and depth: *keep last*, 5. At most five messages wait; older ones are dropped.
#
# Many tutorials pass `10` instead of QoS policies, which means reliable, with a queue of 10 messages. **Predict** how many frames such a subscription receives from the camera in two seconds. (The camera sends ten per second.)

# %% role="predict"
guess_received = None  # your guess: how many frames?

# %% tags=["nbval-ignore-output"]
import time

reliable_count = "unknown without ROS 2"
if ros_available():
    reliable = ImageSubscriber(camera.topic, qos="reliable")
    time.sleep(2)
    reliable_count = reliable.received
compare_guess(guess_received, reliable_count)

# %%
# Check: nothing arrived
assert not ros_available() or reliable_count == 0

# %% [markdown]
# Nothing arrives, and ROS raises no error. The subscription requests more (reliable) than the camera offers (best effort), so ROS does not connect them. The course's subscriber warns in red (here or below a later cell), and keeps the reason:

# %% tags=["nbval-ignore-output"]
if ros_available():
    print(reliable.wait_for_incompatible_qos())
    reliable.stop()

# %%
# Check: the reason is known, and nothing has arrived since
assert not ros_available() or (reliable.received == 0 and reliable.incompatible_qos)

# %% [markdown]
# **Repair it**: do not request more than the camera offers. This `QoSProfile` is what camera drivers use, and the default of this course's subscriber.

# %%
if ros_available():
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    camera_qos = QoSProfile(
        depth=5,
        reliability=ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.VOLATILE,
    )

# %% tags=["nbval-ignore-output"]
if ros_available():
    repaired = ImageSubscriber(camera.topic, qos=camera_qos)
    repaired.wait(timeout=10)
    print("frames received:", repaired.received)
    repaired.stop()

# %%
# Check: the repaired subscription receives frames
assert not ros_available() or repaired.received > 0
assert not ros_available() or not repaired.incompatible_qos

# %% [markdown]
# ## Recap
#
# `encoding`, `step` and `is_bigendian` say what the bytes of a message mean. A subscription must not request more than the publisher offers: a camera offers *best effort*, and a subscription that requests *reliable* receives nothing, without an error.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `message.data` | (2764800,) | uint8 | 0 to 255 | byte |
# | rows of `step` bytes | (720, 3840) | uint8 | 0 to 255 | byte |
# | *frame* | (720, 1280, 3) | uint8 | 0 to 255 | gray level of a channel |
#
# **Next:** [[grayscale]]. First choose **File → Close and Shut Down Notebook**: it frees the camera.

# %%
# Check: the table above
assert np.frombuffer(message.data, np.uint8).shape == (2764800,)
assert by_hand.shape == (720, 1280, 3) and message.step == 3840
