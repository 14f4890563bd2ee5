# ---
# jupyter:
#   imgproc_course:
#     title: Images as messages
#     minutes: 50
# ---

# %% [markdown]
# # 02 · Images as messages
#
# A robot's camera does not send pictures. It sends *messages*: a few numbers that describe a picture, and one long row of bytes.
# Whoever reads the bytes must believe the numbers, or sees a wrong picture.
#
# **You will be able to**
# - name the fields of a `sensor_msgs/Image` and say what each is for,
# - turn the bytes of a message into an array by hand, and back,
# - recognise two classic wrong pictures (red and blue swapped; a sheared picture) and repair them,
# - subscribe to a camera that sends best-effort, and say why a reliable subscriber hears nothing.
#
# **Time** about 50 minutes. **You need** lesson 00, and to know that a NumPy array has a shape and a dtype.
#
# If the next cell says *No module named 'imgproc_course'*, open the lessons with `environment/lab`, as lesson 00 explains.

# %%
from types import SimpleNamespace

import cv2
import numpy as np

from imgproc_course.display import live_view, show
from imgproc_course.exercises import check
from imgproc_course.messages import array_to_image, compressed_to_array, encoding_info, image_to_array
from imgproc_course.messages.cv_bridge import CvBridge
from imgproc_course.recording import open_recording
from imgproc_course.ros import ImageSubscriber, open_camera, ros_available

# %% [markdown]
# ## 1 · A picture is a message (8 minutes)
#
# **Ask.** What arrives when a camera sends a picture?
# We take the first picture of the recorded drive, put it into a message as the robot does, and look at every field but the bytes.

# %%
recording = open_recording("drive")
message = array_to_image(recording.frame(0, encoding="rgb8"), "rgb8", recording.message(0).header)

for field in ("height", "width", "encoding", "is_bigendian", "step"):
    print(f"{field:13} {getattr(message, field)!r}")
print(f"{'data':13} {len(message.data)} bytes, the first six: {list(message.data[:6])}")

# %% [markdown]
# | field | what it says |
# |---|---|
# | `height`, `width` | rows and columns of the picture, in pixels |
# | `encoding` | what the bytes of one pixel mean: `rgb8` is red, green, blue, one byte each |
# | `step` | how many bytes one row takes in `data` |
# | `is_bigendian` | for numbers of two bytes and more: does the big end come first? |
# | `data` | all rows, one after the other |
# | `header` | when the picture was taken, and by which camera |
#
# **Predict.** How many bytes are in `data`? Work it out on paper from height, width and the bytes of a pixel before you run the next cell.

# %%
bytes_per_pixel = 3
size = message.height * message.width * bytes_per_pixel
print(f"{message.height} rows × {message.width} columns × {bytes_per_pixel} bytes = {size}")

assert size == len(message.data) == 2_764_800
assert message.step == message.width * bytes_per_pixel == 3840

# %% [markdown]
# ## 2 · Find a pixel by hand (10 minutes)
#
# **Ask.** Where in that row of bytes is the pixel of row 1, column 2? A picture small enough to read tells more than a big one: five rows of five pixels, one byte each, encoding `mono8`.

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
show(tiny, "data, cut into rows of step = 5 bytes", encoding="mono8",
     caption="The tens digit of each value is its row and the units digit its column, so a wrong cut shows at once.",
     alt="A five by five grid of gray squares with the numbers 10 to 54 in them.")

# %% [markdown]
# One row takes `step` bytes. So row 1 begins at byte `1 * step`, and column 2 stands two bytes further on.
#
# $$\text{position} = \text{row} \cdot \text{step} + \text{column} \cdot \text{bytes per pixel}$$
#
# **Predict** the value at row 1, column 2, then run the cell.

# %%
row, column = 1, 2
position = row * tiny_message.step + column * 1
print("byte", position, "holds", tiny_message.data[position])

assert position == 7
assert tiny_message.data[position] == tiny[row, column] == 22

# %% [markdown]
# **All pixels at once.** `np.frombuffer` looks at the bytes as numbers without copying them; `reshape` cuts them into rows.

# %%
flat = np.frombuffer(tiny_message.data, dtype=np.uint8)
decoded = flat.reshape(tiny_message.height, tiny_message.step)
print("flat   ", flat.shape, flat.dtype)
print("decoded", decoded.shape, decoded.dtype, "range", decoded.min(), "to", decoded.max())

assert (decoded == tiny).all()

# %% [markdown]
# The same three lines decode the camera's picture, with one number more: three bytes a pixel.

# %%
flat = np.frombuffer(message.data, dtype=np.uint8)
frame = flat.reshape(message.height, message.width, 3)
print("frame", frame.shape, frame.dtype, "range", frame.min(), "to", frame.max())

assert frame.shape == (720, 1280, 3)
show(frame, "decoded by hand", encoding="rgb8",
     caption="The first picture of the drive, from 2,764,800 bytes and three lines of NumPy.",
     alt="A living room seen from close to the floor, with a red and white ball ahead.")

# %% [markdown]
# ## 3 · Planned failure: whose red is it? (6 minutes)
#
# OpenCV keeps its pixels as blue, green, red. The robot sends red, green, blue. The bytes do not know: only `encoding` does.
#
# **Predict.** The ball ahead is red and white. What colour will it have if somebody takes `rgb8` bytes for `bgr8`?

# %%
show([frame, frame], ["told the truth: rgb8", "told a lie: bgr8"], encoding=["rgb8", "bgr8"],
     caption="The same bytes shown twice: read as bgr8, the red ball turns blue and the wooden floor turns blue-gray.",
     alt="Two copies of the living room; in the right one all reds are blue.")

ball = frame[388, 551]
print("a pixel on the ball's red stripe, as it lies in data:", ball)

# %% [markdown]
# No error was raised, and that is the trap. Now **repair it**: OpenCV wants `bgr8`, so the channels must change places. `image_to_array` reads `encoding` and does it when it is told what you want.

# %%
bgr = image_to_array(message, "bgr8")
print("rgb8 bytes:", frame[388, 551], "  as bgr8:", bgr[388, 551])

assert (bgr == frame[..., ::-1]).all()
assert bgr[388, 551].tolist() == frame[388, 551].tolist()[::-1]

# %% [markdown]
# ## 4 · Planned failure: a padded row (8 minutes)
#
# Many cameras let every row begin at a round address, and fill the rest of the row with bytes that mean nothing: *padding*. Then `step` is larger than width × bytes per pixel.
#
# **Try.** Five columns, but a step of eight: the last three bytes of each row (here 99) are padding.

# %%
padded_rows = np.full((5, 8), 99, dtype=np.uint8)
padded_rows[:, :5] = tiny
padded = SimpleNamespace(height=5, width=5, encoding="mono8", is_bigendian=0, step=8, data=padded_rows.tobytes())
print("bytes:", len(padded.data), "  height × width:", padded.height * padded.width)

assert len(padded.data) == 40

# %% [markdown]
# **Predict.** A hurried programmer takes the first 25 bytes and cuts them into rows of five. Which number will stand in row 1, column 0?

# %%
hurried = np.frombuffer(padded.data, np.uint8)[:25].reshape(5, 5)
careful = np.frombuffer(padded.data, np.uint8).reshape(padded.height, padded.step)[:, : padded.width]
show([hurried, careful], ["width instead of step", "cut by step, then crop"], encoding="mono8",
     caption="On the left every row starts three pixels late and padding (99) shows through: the picture is sheared.",
     alt="Two five by five grids of numbers: the left one has 99 scattered in it, the right one counts 10 to 54.")

assert hurried[1, 0] == 99
assert (careful == tiny).all()

# %% [markdown]
# The same mistake on the camera's picture, with rows padded by a single pixel:

# %%
wide = np.zeros((720, 1280 + 1, 3), np.uint8)
wide[:, :1280] = frame
sheared = wide.reshape(-1)[: 720 * 1280 * 3].reshape(720, 1280, 3)
show(sheared, "padding read as pixels", encoding="rgb8",
     caption="Each row is shifted by one more pixel than the row above it: the room leans.",
     alt="The living room leaning to the right, wrapped around at the picture's edge.")

assert (sheared[1, 0] == 0).all() and (sheared[700, 700:] == frame[700, :580]).all()

# %% [markdown]
# `image_to_array` goes by `step`. And where a message contradicts itself, it does not guess: it says which field is wrong, what it expected, and what to do.

# %%
assert (image_to_array(padded) == tiny).all()

cut_short = SimpleNamespace(**{**vars(padded), "data": padded.data[:20]})
try:
    image_to_array(cut_short)
except ValueError as error:
    print(error)

# %% [markdown]
# ## 5 · Which end comes first? (4 minutes)
#
# A depth camera needs numbers above 255, so each pixel takes two bytes: encoding `16UC1` or `mono16`. Two bytes can be written in two orders.
#
# **Predict.** The bytes are 1 and 2. Big end first, that is 1 × 256 + 2. And little end first?

# %%
two_bytes = bytes([1, 2])
big = np.frombuffer(two_bytes, dtype=">u2")[0]
little = np.frombuffer(two_bytes, dtype="<u2")[0]
print("big end first:", big, "  little end first:", little)

assert big == 258 and little == 513

# %% [markdown]
# `is_bigendian` in the message says which it is; nearly every robot sends 0, little end first. A reader that ignores the field is right nearly always, and wildly wrong otherwise.

# %%
for is_bigendian in (0, 1):
    depth = SimpleNamespace(height=1, width=1, encoding="16UC1", is_bigendian=is_bigendian, step=2, data=two_bytes)
    print("is_bigendian", is_bigendian, "->", image_to_array(depth))

assert image_to_array(depth)[0, 0] == 258

# %% [markdown]
# ## 6 · Let the library do it (5 minutes)
#
# ROS 2 has its own converter, `cv_bridge`. It does not come from pip; the course's `CvBridge` has the same names and gives the same bytes, so what you learn here runs on a robot with one line changed.
#
# **Check** that three ways agree: by hand, with the course's function, with `CvBridge`.

# %%
by_hand = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, : message.width * 3]
by_hand = by_hand.reshape(message.height, message.width, 3)
by_function = image_to_array(message)
by_bridge = CvBridge().imgmsg_to_cv2(message, desired_encoding="passthrough")

assert (by_hand == by_function).all() and (by_hand == by_bridge).all()
print("three ways, pixels that differ:", int((by_hand != by_function).sum() + (by_hand != by_bridge).sum()))

# %% [markdown]
# **A view is not a copy.** When nothing must change, `image_to_array` only *looks* at the message's bytes. That takes no time, but drawing into the array would draw into the message. So the array is read-only, and a copy is what you draw on.

# %%
print("may be written to:", by_function.flags.writeable)
canvas = by_function.copy()
cv2.circle(canvas, (546, 380), 40, (255, 255, 0), thickness=4)  # OpenCV's points are (column, row)
show(canvas[310:450, 446:646], "a circle on a copy", encoding="rgb8",
     caption="The circle is on the copy; the message still holds what the camera saw.",
     alt="The red and white ball with a yellow circle around it.")

assert not by_function.flags.writeable
assert (image_to_array(message) == frame).all()

# %% [markdown]
# Every name that a camera may write into `encoding` has a dtype and a number of channels:

# %%
for name in ("mono8", "rgb8", "bgra8", "16UC1", "32FC1"):
    info = encoding_info(name)
    print(f"{name:6} {np.dtype(info.dtype).name:8} channels {info.channels}")

assert encoding_info("rgb8").channels == 3 and np.dtype(encoding_info("16UC1").dtype) == np.uint16

# %% [markdown]
# ## 7 · Your turn: decode a message (10 minutes)
#
# Write `decode(message)`. It gets an object with the fields of an Image and gives back its pixels as an array:
#
# - `mono8`: shape (height, width), dtype uint8; `rgb8` and `bgr8`: shape (height, width, 3), dtype uint8, the channels as they lie in `data`;
# - `mono16`: shape (height, width), dtype uint16, with the byte order that `is_bigendian` says;
# - rows may be padded: `step` counts.
#
# Use NumPy alone. The course's converter and `cv2` are refused here: this time you are the converter.

# %% role="exercise"
from types import SimpleNamespace

exercise(
    "messages-decode",
    title="Decode a message by hand",
    function="decode",
    time_limit=5,
    refused=("cv2", "imgproc_course.messages"),
    hint="Cut data into rows of step bytes first; crop the padding; only then make pixels of what is left.",
)


def make_message(rng, encoding, channels, padding, *, dtype="u1", is_bigendian=0):
    height, width = (int(n) for n in rng.integers(2, 6, size=2))
    width += height  # never square: rows and columns must not be confused
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
    channels = {"mono8": 1, "mono16": 1, "rgb8": 3, "bgr8": 3}[message.encoding]
    order = ">" if message.is_bigendian else "<"
    dtype = np.dtype(order + ("u2" if message.encoding == "mono16" else "u1"))
    row_bytes = message.width * channels * dtype.itemsize
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, :row_bytes]
    pixels = np.ascontiguousarray(rows).view(dtype).astype(dtype.newbyteorder("="))
    shape = (message.height, message.width) if channels == 1 else (message.height, message.width, channels)
    return pixels.reshape(shape)


# %% role="check" exercise="messages-decode"
check("messages-decode", decode)


# %% role="case" exercise="messages-decode" title="a colour picture without padding" points=1
def inputs(rng):
    return (make_message(rng, "rgb8", 3, 0),)


# %% role="case" exercise="messages-decode" title="a colour picture with padded rows" points=1
def inputs(rng):
    return (make_message(rng, "bgr8", 3, int(rng.integers(1, 6))),)


# %% role="case" exercise="messages-decode" title="a gray picture with padded rows" points=1
def inputs(rng):
    return (make_message(rng, "mono8", 1, int(rng.integers(1, 6))),)


# %% role="case" exercise="messages-decode" title="16 bits, big end first" points=1
def inputs(rng):
    return (make_message(rng, "mono16", 1, 2, dtype="u2", is_bigendian=1),)


# %% role="case" exercise="messages-decode" title="16 bits, little end first" points=1
def inputs(rng):
    return (make_message(rng, "mono16", 1, 0, dtype="u2"),)


# %% role="hidden" exercise="messages-decode" title="padding that is no whole pixel" points=1 hint="The padding may be one byte where a pixel has three or two: crop bytes, not pixels."
def inputs(rng):
    return (make_message(rng, "rgb8", 3, 1),)


# %% role="hidden" exercise="messages-decode" title="16 bits, little end first, padded" points=1 hint="Is the byte order read from the message, or always the same?"
def inputs(rng):
    return (make_message(rng, "mono16", 1, 3, dtype="u2"),)


# %% role="mistake" exercise="messages-decode" name="padding read as pixels" says="Each row starts where the last one's pixels ended: the padding was read as pixels and the picture is sheared. Cut data into rows of step bytes, then crop."
def decode(message):
    channels = {"mono8": 1, "mono16": 1, "rgb8": 3, "bgr8": 3}[message.encoding]
    dtype = np.dtype((">" if message.is_bigendian else "<") + ("u2" if message.encoding == "mono16" else "u1"))
    count = message.height * message.width * channels
    pixels = np.frombuffer(message.data, dtype, count=count).astype(dtype.newbyteorder("="))
    shape = (message.height, message.width) if channels == 1 else (message.height, message.width, channels)
    return pixels.reshape(shape)


# %% role="mistake" exercise="messages-decode" name="channels turned around" says="Red and blue have changed places. The task asks for the channels as they lie in data."
def decode(message):
    return solution(message)[..., ::-1] if message.encoding in ("rgb8", "bgr8") else solution(message)


# %% role="mistake" exercise="messages-decode" name="rows and columns exchanged" says="Height and width have changed places: the first axis of an array is its rows, so the shape begins with height."
def decode(message):
    pixels = solution(message)
    return pixels.reshape((message.width, message.height, *pixels.shape[2:]))


# %% role="mistake" exercise="messages-decode" name="the wrong end first" says="The two bytes of each pixel were read in the wrong order: is_bigendian says which end comes first."
def decode(message):
    pixels = solution(message)
    return pixels.byteswap() if message.encoding == "mono16" and message.is_bigendian else pixels


# %% [markdown]
# ## 8 · The header: when, and by whom (3 minutes)
#
# A picture without its time is of little use to a moving robot. `header.stamp` is the moment when the picture was taken, `header.frame_id` the camera's place on the robot. A node that publishes a processed picture copies the header, so that whoever receives it knows which moment it shows.

# %%
stamps = recording.stamps
print("frame_id:", message.header.frame_id)
print("pictures:", len(recording), "  from first to last:", (stamps[-1] - stamps[0]) / 1e9, "s")
print("between two pictures:", np.median(np.diff(stamps)) / 1e6, "ms")

assert message.header.frame_id == "camera_front"
assert len(recording) == 90 and np.median(np.diff(stamps)) == 100_000_000  # nanoseconds

# %% [markdown]
# ## 9 · Raw or compressed? (4 minutes)
#
# The robot sends each picture twice: raw on `image_raw`, and as a JPEG on `image_raw/compressed`. **Predict** how many times smaller the JPEG is.

# %%
compressed = recording.message(0)
raw_bytes, jpeg_bytes = len(message.data), len(compressed.data)
print(f"raw {raw_bytes:,} bytes, JPEG {jpeg_bytes:,} bytes: {raw_bytes / jpeg_bytes:.1f} times smaller")
print(f"ten a second: raw {raw_bytes * 80 / 1e6:.0f} Mbit/s, JPEG {jpeg_bytes * 80 / 1e6:.0f} Mbit/s")
print(f"packets of UDP, at most 65,507 bytes each: raw {-(-raw_bytes // 65_507)}, JPEG {-(-jpeg_bytes // 65_507)}")

assert jpeg_bytes == 159_329 and round(raw_bytes / jpeg_bytes, 1) == 17.4
assert round(raw_bytes * 80 / 1e6) == 221 and round(jpeg_bytes * 80 / 1e6) == 13
assert -(-raw_bytes // 65_507) == 43

# %% [markdown]
# 221 Mbit/s is more than most Wi-Fi carries, and a best-effort picture of 43 packets is lost when one of them is. Over Wi-Fi, subscribe to the compressed topic. Its price: JPEG changes pixels a little each time it is made.

# %%
once = compressed_to_array(compressed, "bgr8")
again = cv2.imdecode(cv2.imencode(".jpg", once, [cv2.IMWRITE_JPEG_QUALITY, 90])[1], cv2.IMREAD_COLOR)
difference = np.abs(once.astype(np.int16) - again)
print("compressed once more: mean change", round(float(difference.mean()), 2), "gray levels, largest", difference.max())

assert 0 < difference.mean() < 2

# %% [markdown]
# ## 10 · A live topic, and the subscriber that hears nothing (8 minutes)
#
# Now the real thing: the recorded drive is published on the robot's own topic, through ROS 2, and this notebook subscribes. (Without ROS on this machine the cells below say so and what to install; everything above works all the same.)

# %%
if ros_available():
    camera = open_camera("recording")
    subscriber = ImageSubscriber(camera.topic, encoding="bgr8")
    live_frame = subscriber.wait(timeout=10)
    print(camera.topic, live_frame.shape, live_frame.dtype)
    assert camera.topic == "/kachaka/front_camera/image_raw"
    assert live_frame.shape == (720, 1280, 3) and live_frame.dtype == np.uint8

# %% [markdown]
# **Planned failure.** A camera sends *best effort*: a lost picture is not sent again, since the next one is more useful. A subscriber may ask for *reliable* delivery, and many tutorials do so by writing a plain `10`. **Predict** what happens.

# %% tags=["nbval-ignore-output"]
if ros_available():
    careless = ImageSubscriber(camera.topic, qos="reliable")
    try:
        careless.wait(timeout=2)
    except TimeoutError:
        print("pictures received in two seconds:", careless.received)
    assert careless.received == 0 and careless.incompatible_qos
    careless.stop()

# %% [markdown]
# Nothing arrives, and ROS raises no error: the two never agreed to talk. The line on red ground comes from the course's subscriber, which asks ROS for the reason: it wanted more (reliable) than the camera offers (best effort). Other subscribers warn once at best, and most tutorials' say nothing. **Repair it**: ask for no more than is offered. `qos="sensor_data"` is best effort, keep the last 5, volatile: what camera drivers use, and what this course's subscriber takes unless told otherwise.

# %% tags=["nbval-ignore-output"]
if ros_available():
    repaired = ImageSubscriber(camera.topic, qos="sensor_data")
    repaired.wait(timeout=10)
    print("received with sensor_data:", repaired.received)
    assert repaired.received > 0 and not repaired.incompatible_qos
    repaired.stop()

# %% [markdown]
# **Look.** The live picture, with one function of yours in between. Move the slider while it runs: `shift` moves the colour channels of the message apart, one pixel at a time.

# %% tags=["nbval-ignore-output"]
def shift_channels(frame, shift=0):
    blue, green, red = frame[..., 0], frame[..., 1], frame[..., 2]
    return np.stack([np.roll(blue, -shift, axis=1), green, np.roll(red, shift, axis=1)], axis=-1)


source = subscriber if ros_available() else recording
view = live_view(source, shift_channels, shift=(0, 40), caption="The drive, its red and blue moved apart.",
                 alt="The living room with coloured fringes, wider as the slider moves to the right.")

# %% [markdown]
# ## Recap
#
# A message is fields and bytes; `encoding`, `step` and `is_bigendian` say what the bytes mean. Believe the fields, and ask for no more than the sender offers.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `message.data` | (2764800,) | uint8 | 0 to 255 | byte |
# | rows, cut by `step` | (720, 3840) | uint8 | 0 to 255 | byte |
# | *frame*, `rgb8` or `bgr8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of a channel |
# | depth, `16UC1` | (360, 640) | uint16 | 0 to 65,535 | millimetre |

# %%
assert np.frombuffer(message.data, np.uint8).shape == (2764800,)
assert by_hand.shape == (720, 1280, 3) and message.step == 3840
assert recording.depth(0).shape == (360, 640) and recording.depth(0).dtype == np.uint16
assert np.iinfo(np.uint16).max == 65_535
