# ---
# jupyter:
#   imgproc_course:
#     title: Images as messages
#     minutes: 75
# ---

# %% [markdown]
# # Images as messages
#
# A robot's camera sends *messages*. A message with an image has a few fields that describe the image, and one long sequence of bytes.
# The fields say how to read the bytes. If you ignore these fields, you read the bytes wrongly.
#
# **You will be able to**
# - name the fields of a `sensor_msgs/Image` (ROS's message type for images) and explain each field,
# - turn the bytes of a message into an array by hand, and back,
# - recognise two common mistakes in an image (red and blue swapped; the rows cut wrongly) and repair them,
# - subscribe to a camera that does not send lost images again, and explain why some subscriptions receive nothing from it.
#
# **Time** about 75 minutes. **You need** [[start_here]]. You should know that a NumPy array has a shape (its numbers of rows, columns and channels) and a dtype (the type of its numbers).
#
# If the next cell says *No module named 'imgproc_course'*, open the lessons with `environment/lab`, as [[start_here]] explains.

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
# ## 1 · An image is a message (7 minutes)
#
# **Ask.** What arrives when a camera sends an image?
# We take the first frame of the recorded drive (a *frame* is one image of a stream) and put it into a message, as the robot does. Then we look at every field except the bytes.

# %%
recording = open_recording("drive")
message = array_to_image(recording.frame(0, encoding="rgb8"), "rgb8", recording.message(0).header)

for field in ("height", "width", "encoding", "is_bigendian", "step"):
    print(f"{field:13} {getattr(message, field)!r}")  # getattr(message, "height") is message.height
print(f"{'data':13} {len(message.data)} bytes, the first six: {list(message.data[:6])}")

# %% [markdown]
# | field | meaning |
# |---|---|
# | `height`, `width` | rows and columns of the image, in pixels |
# | `encoding` | the channels of a pixel and their type: `rgb8` has the channels red, green and blue, one byte (8 bits) each |
# | `step` | number of bytes per row in `data` |
# | `is_bigendian` | for numbers of two or more bytes: is the more significant byte first? |
# | `data` | all rows, one after the other |
# | `header` | when the image was taken, and by which camera (section 8) |
#
# **Predict.** How many bytes are in `data`? Before you run the next cell, calculate it on paper from the height, the width and the bytes per pixel.

# %%
bytes_per_pixel = 3
total_bytes = message.height * message.width * bytes_per_pixel
print(f"{message.height} rows × {message.width} columns × {bytes_per_pixel} bytes = {total_bytes}")

assert total_bytes == len(message.data) == 2_764_800
assert message.step == message.width * bytes_per_pixel == 3840

# %% [markdown]
# ## 2 · Find a pixel by hand (10 minutes)
#
# **Ask.** At which position in `data` is the pixel of row 1, column 2? We use an image that is small enough to read: five rows of five pixels. Its encoding is `mono8`: one channel, one byte per pixel. With one channel, the value of a pixel is its *intensity*, also called its *gray level*: 0 is black and 255 is white.

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
     caption="In each value, the first digit counts the rows (from 1) and the second digit counts the columns (from 0). So you can see at once if the rows are cut wrongly.",
     alt="A five by five grid of gray squares with the numbers 10 to 54 in them.")

# %% [markdown]
# Rows, columns and bytes are counted from 0. One row takes `step` bytes. So row 1 begins at byte `1 * step`, and column 2 is two bytes after that.
#
# $$\text{position} = \text{row} \cdot \text{step} + \text{column} \cdot \text{bytes per pixel}$$
#
# **Predict** the value at row 1, column 2, then run the cell.

# %%
row, column = 1, 2
position = row * tiny_message.step + column * 1  # 1 byte per pixel
print("byte", position, "holds", tiny_message.data[position])

assert position == 7
assert tiny_message.data[position] == tiny[row, column] == 22

# %% [markdown]
# **All pixels at once.** `np.frombuffer` makes an array from the bytes without copying them. `reshape` then cuts the array into rows.

# %%
flat = np.frombuffer(tiny_message.data, dtype=np.uint8)
decoded = flat.reshape(tiny_message.height, tiny_message.step)
print("flat   ", flat.shape, flat.dtype)
print("decoded", decoded.shape, decoded.dtype, "range", decoded.min(), "to", decoded.max())

assert (decoded == tiny).all()

# %% [markdown]
# The same lines decode the camera's image. `reshape` only needs one more number: three channels per pixel.

# %%
flat = np.frombuffer(message.data, dtype=np.uint8)
frame = flat.reshape(message.height, message.width, 3)
print("frame", frame.shape, frame.dtype, "range", frame.min(), "to", frame.max())

assert frame.shape == (720, 1280, 3)
show(frame, "decoded by hand", encoding="rgb8",
     caption="The first frame of the drive: two lines of NumPy decoded it from 2,764,800 bytes.",
     alt="A living room seen from close to the floor, with a red and white ball ahead.")

# %% [markdown]
# ## 3 · Planned failure: which channel is red? (6 minutes)
#
# OpenCV stores the channels of a pixel in the order blue, green, red. The robot sends red, green, blue. You cannot see the order in the bytes. Only `encoding` tells you the order.
#
# **Predict.** The ball ahead is red and white. Which colour will replace the red if a program reads `rgb8` bytes as `bgr8`?

# %%
show([frame, frame], ["correct: read as rgb8", "wrong: read as bgr8"], encoding=["rgb8", "bgr8"],
     caption="The same bytes shown twice: read as bgr8, the red ball turns blue and the wooden floor turns blue-gray.",
     alt="Two copies of the living room. In the second one everything red is blue.")

ball = frame[388, 551]
print("a pixel on the ball's red stripe, in the order of data:", ball)

# %% [markdown]
# Python raised no error, so this mistake is easy to overlook. Now **repair it**: OpenCV needs `bgr8`, so red and blue must be swapped. `image_to_array` reads `encoding`. If you ask for another encoding, it reorders the channels.

# %%
bgr = image_to_array(message, "bgr8")
print("rgb8 bytes:", frame[388, 551], "  as bgr8:", bgr[388, 551])

assert (bgr == frame[..., ::-1]).all()  # ... means all rows and columns; ::-1 reverses the channels
assert bgr[388, 551].tolist() == frame[388, 551].tolist()[::-1]

# %% [markdown]
# ## 4 · Planned failure: a padded row (8 minutes)
#
# Many cameras start every row at a multiple of, for example, 16 bytes. They fill the rest of the row with bytes that have no meaning: *padding*. Then `step` is larger than width × bytes per pixel.
#
# **Try.** This image has five columns, but a step of eight: the last three bytes of each row (here 99) are padding.

# %%
padded_rows = np.full((5, 8), 99, dtype=np.uint8)
padded_rows[:, :5] = tiny  # all rows, the first five columns
padded = SimpleNamespace(height=5, width=5, encoding="mono8", is_bigendian=0, step=8, data=padded_rows.tobytes())  # an object with the fields of a message
print("bytes:", len(padded.data), "  height × width:", padded.height * padded.width)

assert len(padded.data) == 40

# %% [markdown]
# **Predict.** A program ignores `step`, takes the first 25 bytes and cuts them into rows of five. Which number will be in row 1, column 0?

# %%
cut_by_width = np.frombuffer(padded.data, np.uint8)[:25].reshape(5, 5)
cut_by_step = np.frombuffer(padded.data, np.uint8).reshape(padded.height, padded.step)[:, : padded.width]
show([cut_by_width, cut_by_step], ["cut by width", "cut by step, then cropped"], encoding="mono8",
     caption="On the left, padding (99) is read as pixels. Each row is shifted by three more pixels than the row above: the image is sheared.",
     alt="Two five by five grids of numbers: the left one has 99 in several places, the right one has the numbers 10 to 54.")

assert cut_by_width[1, 0] == 99
assert (cut_by_step == tiny).all()

# %% [markdown]
# Here is the same mistake with the camera's image. Every row is padded by one pixel:

# %%
wide = np.zeros((720, 1280 + 1, 3), np.uint8)
wide[:, :1280] = frame
sheared = wide.reshape(-1)[: 720 * 1280 * 3].reshape(720, 1280, 3)
show(sheared, "padding read as pixels", encoding="rgb8",
     caption="Each row is shifted by one more pixel than the row above it, so vertical edges become diagonal.",
     alt="The living room, slanted; what leaves the image on one side comes in again on the other side.")

assert (sheared[1, 0] == 0).all() and (sheared[700, 700:] == frame[700, :580]).all()

# %% [markdown]
# `image_to_array` uses `step`. If the fields of a message contradict each other, it raises an error. The error says which field is wrong, which value was expected, and what you can do.

# %%
assert (image_to_array(padded) == tiny).all()

cut_short = SimpleNamespace(**{**vars(padded), "data": padded.data[:20]})  # the same fields, but only 20 bytes
try:
    image_to_array(cut_short)
except ValueError as error:
    print(error)

# %% [markdown]
# ## 5 · Which byte comes first? (4 minutes)
#
# A depth camera measures distances. It needs numbers above 255, so a pixel takes two bytes. The encoding is `16UC1` (16 bits, unsigned, 1 channel) or `mono16`. Two bytes can be stored in two orders. *Big-endian* stores the more significant byte first, *little-endian* the less significant one.
#
# **Predict.** The bytes are 1 and 2. In big-endian order they mean 1 × 256 + 2. What do they mean in little-endian order?

# %%
two_bytes = bytes([1, 2])
big = np.frombuffer(two_bytes, dtype=">u2")[0]  # > big-endian, u unsigned, 2 bytes
little = np.frombuffer(two_bytes, dtype="<u2")[0]  # < little-endian
print("big-endian:", big, "  little-endian:", little)

assert big == 258 and little == 513

# %% [markdown]
# The field `is_bigendian` gives the order. Nearly every robot sends 0: little-endian. So a program that ignores the field usually works. But with a big-endian message all its distances are wrong.

# %%
for is_bigendian in (0, 1):
    depth = SimpleNamespace(height=1, width=1, encoding="16UC1", is_bigendian=is_bigendian, step=2, data=two_bytes)
    print("is_bigendian", is_bigendian, "->", image_to_array(depth))

assert image_to_array(depth)[0, 0] == 258

# %% [markdown]
# ## 6 · Use the library (5 minutes)
#
# ROS 2 has its own converter, `cv_bridge`, but pip cannot install it. The course's `CvBridge` has methods with the same names, and for correct messages the same results. So your code runs on a robot after you change one line: the import.
#
# **Check** that three ways give the same array: by hand, with the course's function, and with `CvBridge`.

# %%
by_hand = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, : message.width * 3]
by_hand = by_hand.reshape(message.height, message.width, 3)
by_function = image_to_array(message)
by_bridge = CvBridge().imgmsg_to_cv2(message, desired_encoding="passthrough")  # keep the message's encoding

assert (by_hand == by_function).all() and (by_hand == by_bridge).all()
print("values that differ between the three ways:", int((by_hand != by_function).sum() + (by_hand != by_bridge).sum()))

# %% [markdown]
# **A view is not a copy.** If no value has to change, `image_to_array` does not copy the bytes of the message. The array is a *view*: it uses the memory of the message. This saves time. But if you drew into the array, you would change the message. So the array is read-only. To draw, make a copy.

# %%
print("writeable:", by_function.flags.writeable)
canvas = by_function.copy()
cv2.circle(canvas, (546, 380), 40, (255, 255, 0), thickness=4)  # OpenCV's points are (column, row)
show(canvas[310:450, 446:646], "a circle on a copy", encoding="rgb8",
     caption="The circle is on the copy. The message still holds the camera's image.",
     alt="The red and white ball with a yellow circle around it.")

assert not by_function.flags.writeable
assert (image_to_array(message) == frame).all()

# %% [markdown]
# Every encoding has a dtype and a number of channels (`32FC1`: 32-bit floating-point numbers, 1 channel):

# %%
for name in ("mono8", "rgb8", "bgra8", "16UC1", "32FC1"):
    info = encoding_info(name)
    print(f"{name:6} {np.dtype(info.dtype).name:8} channels {info.channels}")

assert encoding_info("rgb8").channels == 3 and np.dtype(encoding_info("16UC1").dtype) == np.uint16

# %% [markdown]
# ## 7 · Your turn: decode a message (20 minutes)
#
# Write `decode(message)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `message`: an object with the fields `height`, `width`, `encoding`, `is_bigendian`, `step` and `data` | the pixels, an array; its shape and dtype depend on the encoding | `decode(padded)` equals `tiny` |
#
# The encodings are:
#
# - `mono8`: shape (height, width), dtype uint8
# - `rgb8` and `bgr8`: shape (height, width, 3), dtype uint8, with the channels in the same order as in `data`
# - `mono16`: shape (height, width), dtype uint16; `is_bigendian` gives the byte order in `data`
#
# Rows may be padded, so use `step`. Use only NumPy: the check refuses an answer that uses `cv2` or the course's converter.

# %% role="exercise"
from types import SimpleNamespace

exercise(
    "messages-decode",
    title="Decode a message by hand",
    function="decode",
    time_limit=5,
    refused=("cv2", "imgproc_course.messages"),
    hint="First cut data into rows of step bytes. Then crop the padding. Then convert the remaining bytes to pixels.",
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


# %% role="case" exercise="messages-decode" title="a colour image without padding" points=1
def inputs(rng):
    return (make_message(rng, "rgb8", 3, 0),)


# %% role="case" exercise="messages-decode" title="a colour image with padded rows" points=1
def inputs(rng):
    return (make_message(rng, "bgr8", 3, int(rng.integers(1, 6))),)


# %% role="case" exercise="messages-decode" title="a gray image with padded rows" points=1
def inputs(rng):
    return (make_message(rng, "mono8", 1, int(rng.integers(1, 6))),)


# %% role="case" exercise="messages-decode" title="16 bits, big-endian" points=1
def inputs(rng):
    return (make_message(rng, "mono16", 1, 2, dtype="u2", is_bigendian=1),)


# %% role="case" exercise="messages-decode" title="16 bits, little-endian" points=1
def inputs(rng):
    return (make_message(rng, "mono16", 1, 0, dtype="u2"),)


# %% role="hidden" exercise="messages-decode" title="padding that is not a whole pixel" points=1 hint="The padding may be one byte although a pixel has two or three: crop bytes, not pixels."
def inputs(rng):
    return (make_message(rng, "rgb8", 3, 1),)


# %% role="hidden" exercise="messages-decode" title="16 bits, little-endian, padded" points=1 hint="Does your function read the byte order from the message, or does it always use the same?"
def inputs(rng):
    return (make_message(rng, "mono16", 1, 3, dtype="u2"),)


# %% role="mistake" exercise="messages-decode" name="padding read as pixels" says="The padding was read as pixels, so the image is sheared. Cut data into rows of step bytes, then crop the padding."
def decode(message):
    channels = {"mono8": 1, "mono16": 1, "rgb8": 3, "bgr8": 3}[message.encoding]
    dtype = np.dtype((">" if message.is_bigendian else "<") + ("u2" if message.encoding == "mono16" else "u1"))
    count = message.height * message.width * channels
    pixels = np.frombuffer(message.data, dtype, count=count).astype(dtype.newbyteorder("="))
    shape = (message.height, message.width) if channels == 1 else (message.height, message.width, channels)
    return pixels.reshape(shape)


# %% role="mistake" exercise="messages-decode" name="channels swapped" says="Red and blue are swapped. The channels must be in the same order as in data."
def decode(message):
    return solution(message)[..., ::-1] if message.encoding in ("rgb8", "bgr8") else solution(message)


# %% role="mistake" exercise="messages-decode" name="rows and columns exchanged" says="Height and width are exchanged. The first axis of an array is its rows, so the shape begins with height."
def decode(message):
    pixels = solution(message)
    return pixels.reshape((message.width, message.height, *pixels.shape[2:]))


# %% role="mistake" exercise="messages-decode" name="wrong byte order" says="The two bytes of a pixel were read in the wrong order. is_bigendian says which byte comes first."
def decode(message):
    pixels = solution(message)
    return pixels.byteswap() if message.encoding == "mono16" and message.is_bigendian else pixels


# %% [markdown]
# ## 8 · The header: time and camera (3 minutes)
#
# A moving robot must know when an image was taken: `header.stamp` is this time. `header.frame_id` names the coordinate frame of the camera. (Here *frame* means a coordinate system, not an image of a stream.) A *node* is a program that takes part in ROS. A node that publishes a processed image copies the header, so that a subscriber knows when the camera took the image.

# %%
stamps = recording.stamps
print("frame_id:", message.header.frame_id)
print("frames:", len(recording), "  from first to last:", (stamps[-1] - stamps[0]) / 1e9, "s")
print("between two frames:", np.median(np.diff(stamps)) / 1e6, "ms")

assert message.header.frame_id == "camera_front"
assert len(recording) == 90 and np.median(np.diff(stamps)) == 100_000_000  # nanoseconds

# %% [markdown]
# ## 9 · Raw or compressed? (4 minutes)
#
# The robot publishes each image twice: raw (not compressed) on the topic `image_raw`, and as a JPEG on the topic `image_raw/compressed`. ROS 2 cuts a large message into packets and sends them with UDP, a network protocol. A UDP packet holds at most 65,507 bytes. **Predict** how many times smaller the JPEG is.

# %%
compressed = recording.message(0)
raw_bytes, jpeg_bytes = len(message.data), len(compressed.data)
print(f"raw {raw_bytes:,} bytes, JPEG {jpeg_bytes:,} bytes: {raw_bytes / jpeg_bytes:.1f} times smaller")
print(f"10 per second: raw {raw_bytes * 80 / 1e6:.0f} Mbit/s, JPEG {jpeg_bytes * 80 / 1e6:.0f} Mbit/s")
print(f"UDP packets of at most 65,507 bytes: raw {-(-raw_bytes // 65_507)}, JPEG {-(-jpeg_bytes // 65_507)}")  # -(-a // b) rounds up

assert jpeg_bytes == 159_329 and round(raw_bytes / jpeg_bytes, 1) == 17.4
assert round(raw_bytes * 80 / 1e6) == 221 and round(jpeg_bytes * 80 / 1e6) == 13
assert -(-raw_bytes // 65_507) == 43

# %% [markdown]
# Many Wi-Fi networks cannot carry 221 Mbit/s reliably. Also, cameras do not send lost packets again: if one of the 43 packets of a raw image is lost, the whole image is lost. So over Wi-Fi, subscribe to the compressed topic. This has a disadvantage: JPEG changes the pixels a little each time an image is compressed.

# %%
once = compressed_to_array(compressed, "bgr8")
again = cv2.imdecode(cv2.imencode(".jpg", once, [cv2.IMWRITE_JPEG_QUALITY, 90])[1], cv2.IMREAD_COLOR)
difference = np.abs(once.astype(np.int16) - again)
print("compressed again: mean change", round(float(difference.mean()), 2), "gray levels, largest", difference.max())

assert 0 < difference.mean() < 2

# %% [markdown]
# ## 10 · A live topic, and a subscription that receives nothing (8 minutes)
#
# Now we use ROS 2: the recorded drive is published on the robot's own topic, and this notebook subscribes to it. (Without ROS, the ROS cells below do nothing; the doctor of [[start_here]] says what to install. Everything above works without ROS.)

# %%
if ros_available():
    camera = open_camera("recording")
    subscriber = ImageSubscriber(camera.topic, encoding="bgr8")
    live_frame = subscriber.wait(timeout=10)
    print(camera.topic, live_frame.shape, live_frame.dtype)
    assert camera.topic == "/kachaka/front_camera/image_raw"
    assert live_frame.shape == (720, 1280, 3) and live_frame.dtype == np.uint8

# %% [markdown]
# **QoS.** Each publisher and each subscription has *Quality of Service* (QoS) policies. They decide how messages are delivered:
#
# | QoS policy | meaning | a camera driver uses |
# |---|---|---|
# | reliability | is a lost message sent again? | *best effort*: no |
# | durability | does a late subscription receive earlier messages? | *volatile*: no |
# | history and depth | how many messages wait in the queue? | keep the last 5 |
#
# **Planned failure.** A camera publishes with *best effort*: it does not send a lost image again, because the next image is more useful. A subscription can request *reliable* delivery. Many tutorials do this without saying so: they pass `10` instead of QoS policies, which means reliable, with a queue of 10 messages. **Predict**: what does such a subscription receive from the camera?

# %% tags=["nbval-ignore-output"]
if ros_available():
    reliable_subscriber = ImageSubscriber(camera.topic, qos="reliable")
    try:
        reliable_subscriber.wait(timeout=2)
    except TimeoutError:
        print("frames received in two seconds:", reliable_subscriber.received)
    assert reliable_subscriber.received == 0 and reliable_subscriber.incompatible_qos
    reliable_subscriber.stop()

# %% [markdown]
# Nothing arrives, and ROS raises no error. The QoS policies are not compatible, so ROS does not connect the publisher and the subscription. The line on a red background is a warning of the course's subscriber. It gives the reason: the subscription requests more (reliable) than the camera offers (best effort). Other subscriptions log one warning at most, which is easy to overlook. **Repair it**: do not request more than the camera offers. `qos="sensor_data"` means best effort, volatile, keep the last 5. Camera drivers use it, and it is the default of this course's subscriber.

# %% tags=["nbval-ignore-output"]
if ros_available():
    repaired = ImageSubscriber(camera.topic, qos="sensor_data")
    repaired.wait(timeout=10)
    print("received with sensor_data:", repaired.received)
    assert repaired.received > 0 and not repaired.incompatible_qos
    repaired.stop()

# %% [markdown]
# **Look** at the live frames. The function below processes each of them. Move the slider while the view runs: `shift` moves the red channel to the right and the blue channel to the left, by the number of pixels that you choose.

# %% tags=["nbval-ignore-output"]
def shift_channels(frame, shift=0):
    blue, green, red = frame[..., 0], frame[..., 1], frame[..., 2]
    # np.roll shifts along the rows (axis=1); np.stack makes one array of the three channels
    return np.stack([np.roll(blue, -shift, axis=1), green, np.roll(red, shift, axis=1)], axis=-1)


source = subscriber if ros_available() else recording
view = live_view(source, shift_channels, shift=(0, 40), caption="The drive, with the red and blue channels moved apart.",
                 alt="The living room with coloured fringes that become wider as the slider moves to the right.")

# %% [markdown]
# ## Recap
#
# A message consists of fields and bytes. `encoding`, `step` and `is_bigendian` say what the bytes mean, so use these fields. A subscription must not request more than the publisher offers.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `message.data` | (2764800,) | uint8 | 0 to 255 | byte |
# | rows of `step` bytes | (720, 3840) | uint8 | 0 to 255 | byte |
# | *frame*, `rgb8` or `bgr8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of a channel |
# | depth, `16UC1` | (360, 640) | uint16 | 0 to 65,535 | millimetre |

# %%
assert np.frombuffer(message.data, np.uint8).shape == (2764800,)
assert by_hand.shape == (720, 1280, 3) and message.step == 3840
assert recording.depth(0).shape == (360, 640) and recording.depth(0).dtype == np.uint16
assert np.iinfo(np.uint16).max == 65_535
