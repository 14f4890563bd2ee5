# %% name="mono16 read as bytes" origin="walk" sentence="A mono16 pixel takes two bytes, and you read every byte as a pixel: for mono16 read the data as uint16." must_say=["two bytes|2 bytes|every byte|16 bit", "as uint16|u2|read .*uint16|uint16 .*read|dtype"] kind="dtype"
def decode(message):
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    if message.encoding in ("rgb8", "bgr8"):
        return rows[:, : message.width * 3].reshape(message.height, message.width, 3)
    return rows[:, : message.width]

# %% name="reshape by width, padding not removed" origin="walk" sentence="Rows may be padded, so the data does not fit height × width: cut it into rows of step bytes first, then crop each row to the width." must_say=["step|padd", "crop|cut|padd"] kind="error"
def decode(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    if message.encoding == "mono8":
        return flat.reshape(message.height, message.width)
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.frombuffer(message.data, dtype=order).reshape(message.height, message.width).astype(np.uint16)
    return flat.reshape(message.height, message.width, 3)

# %% name="first bytes cut by width" origin="walk" sentence="You cut rows of width bytes, but a padded row is step bytes long, so the padding shows and the image is sheared: reshape by step, then crop." must_say=["step|padd", "padd|shear|crop|\\bcut\\b"] kind="value"
def decode(message):
    h, w = message.height, message.width
    flat = np.frombuffer(message.data, dtype=np.uint8)
    if message.encoding == "mono8":
        return flat[: h * w].reshape(h, w)
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.frombuffer(message.data, dtype=order)[: h * w].reshape(h, w).astype(np.uint16)
    return flat[: h * w * 3].reshape(h, w, 3)

# %% name="byte order ignored" origin="walk" sentence="You read mono16 always with the little end first; where is_bigendian is 1 the more significant byte comes first, so choose the dtype by that field." must_say=["endian|byte order|significant", "is_bigendian|>u2|field"] must_not_say=["padd"] kind="value"
def decode(message):
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono16":
        pixels = np.ascontiguousarray(rows[:, : message.width * 2])
        return pixels.view("<u2").reshape(message.height, message.width).astype(np.uint16)
    if message.encoding == "mono8":
        return rows[:, : message.width]
    return rows[:, : message.width * 3].reshape(message.height, message.width, 3)

# %% name="byte orders swapped" origin="new" sentence="You have the two byte orders the wrong way round: > means the big end first, and belongs to is_bigendian = 1." must_say=["endian|byte order|big end", "swap|exchang|wrong way|other way|revers|turned|>"] must_not_say=["padd"] kind="value"
def decode(message):
    h, w, step = message.height, message.width, message.step
    rows = np.frombuffer(message.data, np.uint8).reshape(h, step)
    if message.encoding == "mono16":
        order = "<u2" if message.is_bigendian else ">u2"
        return np.ascontiguousarray(rows[:, : 2 * w]).view(order).astype(np.uint16)
    if message.encoding == "mono8":
        return rows[:, :w]
    return rows[:, : 3 * w].reshape(h, w, 3)

# %% name="rgb8 turned into bgr" origin="new" sentence="You turn the channels of rgb8 around, but the task wants them as they lie in data: leave out the [..., ::-1]." must_say=["channel|::-1|bgr", "as they (lie|are|stand|come)|leave out|\\bturn(ed|s)?\\b|revers|swap"] must_not_say=["endian"] kind="value"
def decode(message):
    h, w, step = message.height, message.width, message.step
    rows = np.frombuffer(message.data, np.uint8).reshape(h, step)
    if message.encoding == "mono8":
        return rows[:, :w]
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.ascontiguousarray(rows[:, : 2 * w]).view(order).astype(np.uint16)
    image = rows[:, : 3 * w].reshape(h, w, 3)
    if message.encoding == "rgb8":
        image = image[..., ::-1]
    return image

# %% name="width and height swapped" origin="new" sentence="The shape begins with the rows: reshape to (height, step), not (width, ...)." must_say=["height", "width", "first|swap|exchang|begin|wrong way|not \\(width"] kind="error"
def decode(message):
    w, h = message.width, message.height
    flat = np.frombuffer(message.data, np.uint8)
    if message.encoding == "mono8":
        return flat.reshape(w, -1)[:, :h]
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.frombuffer(message.data, order).reshape(w, -1)[:, :h].astype(np.uint16)
    return flat.reshape(w, -1)[:, : h * 3].reshape(w, h, 3)

# %% name="colour row cropped to width bytes" origin="new" sentence="A colour row has width × 3 bytes before the padding, and you keep only width of them: crop at width * 3 before you reshape." must_say=["\\b3\\b|three", "crop|keep only|width bytes|too few|width ?(\\*|×) ?3"] kind="error"
def decode(message):
    h, w = message.height, message.width
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.ascontiguousarray(rows[:, : 2 * w]).view(order).astype(np.uint16)
    rows = rows[:, :w]
    if message.encoding == "mono8":
        return rows
    return rows.reshape(h, w, 3)

# %% name="padding kept" origin="new" sentence="You cut the data into rows of step bytes, but the padding at the end of each row is still there: keep only the first width columns." must_say=["padd|end of (each|every|the) row|too wide|too many columns", "keep only|crop|still|remove|cut off|columns"] kind="shape"
def decode(message):
    h = message.height
    flat = np.frombuffer(message.data, np.uint8)
    if message.encoding == "mono8":
        return flat.reshape(h, message.step)
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.frombuffer(message.data, order).reshape(h, message.step // 2).astype(np.uint16)
    rows = flat.reshape(h, message.step)
    return rows[:, : message.step // 3 * 3].reshape(h, message.step // 3, 3)

# %% name="mono16 as uint8 after reading" origin="new" sentence="You read the right numbers and then narrow them to uint8, so everything above 255 is lost: mono16 stays uint16." must_say=["uint8", "uint16", "lost|narrow|stays|keep|cut"] kind="dtype"
def decode(message):
    h, w = message.height, message.width
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)
    if message.encoding == "mono8":
        image = rows[:, :w]
    elif message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        image = np.ascontiguousarray(rows[:, : 2 * w]).view(order)
    else:
        image = rows[:, : 3 * w].reshape(h, w, 3)
    return image.astype(np.uint8)

# %% name="colour flattened to two dimensions" origin="new" sentence="For rgb8 and bgr8 you return (height, 3 × width), without the axis of the channels: reshape to (height, width, 3)." must_say=["channel|axis|dimension", "height, width, 3|third|last axis|reshape"] kind="shape"
def decode(message):
    h, w = message.height, message.width
    size = {"mono8": 1, "mono16": 2, "rgb8": 3, "bgr8": 3}[message.encoding]
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)[:, : w * size]
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.ascontiguousarray(rows).view(order).astype(np.uint16)
    return rows

# %% name="channels first" origin="new" sentence="You put the channels first, (3, height, width), as if data held one whole plane per colour: the three bytes of a pixel stand side by side, so the shape is (height, width, 3)." must_say=["channel|plane|colou?r", "first|side by side|together|last"] kind="shape"
def decode(message):
    h, w = message.height, message.width
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)
    if message.encoding == "mono8":
        return rows[:, :w]
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.ascontiguousarray(rows[:, : 2 * w]).view(order).astype(np.uint16)
    return rows[:, : 3 * w].reshape(3, h, w)

# %% name="the course's converter" origin="new" sentence="image_to_array is refused in this task, because here you are the converter: use np.frombuffer and reshape." must_say=["image_to_array|converter|imgproc_course|course", "refus|not allowed|yourself|numpy|frombuffer|forbid"] kind="refused"
from imgproc_course.messages import image_to_array


def decode(message):
    return image_to_array(message)

# %% name="cv2 converts" origin="new" sentence="cv2 is refused in this task: read the bytes with np.frombuffer and cut them yourself." must_say=["cv2|opencv", "refus|not allowed|numpy|frombuffer|forbid"] kind="refused"
import cv2


def decode(message):
    h, w = message.height, message.width
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)
    if message.encoding == "mono8":
        return cv2.copyMakeBorder(rows[:, :w], 0, 0, 0, 0, cv2.BORDER_REPLICATE)
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.ascontiguousarray(rows[:, : 2 * w]).view(order).astype(np.uint16)
    return cv2.resize(rows[:, : 3 * w].reshape(h, w, 3), (w, h))

# %% name="array made of data without frombuffer" origin="new" sentence="np.array(message.data) makes one single object of the bytes, not their numbers: np.frombuffer(message.data, np.uint8) reads them." must_say=["frombuffer|list\\(", "np\\.array|single|object|one value"] kind="error"
def decode(message):
    rows = np.array(message.data).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, : message.width]
    if message.encoding == "mono16":
        return rows[:, : message.width * 2].view("<u2")
    return rows[:, : message.width * 3].reshape(message.height, message.width, 3)

# %% name="lists of lists from a loop" origin="new" sentence="You return a list of lists, and an array was asked for: wrap it in np.array(..., dtype=np.uint8)." must_say=["\\blists?\\b", "array"] kind="type"
def decode(message):
    h, w = message.height, message.width
    if message.encoding == "mono16":
        step = message.step
        result = []
        for y in range(h):
            row = []
            for x in range(w):
                a, b = message.data[y * step + 2 * x], message.data[y * step + 2 * x + 1]
                row.append(a * 256 + b if message.is_bigendian else b * 256 + a)
            result.append(row)
        return result
    size = 1 if message.encoding == "mono8" else 3
    result = []
    for y in range(h):
        row = []
        for x in range(w):
            start = y * message.step + x * size
            pixel = list(message.data[start : start + size])
            row.append(pixel[0] if size == 1 else pixel)
        result.append(row)
    return result

# %% name="dtype int64 from the list" origin="new" sentence="The values are right, but np.array makes int64 of Python numbers: say the dtype, np.uint8 (np.uint16 for mono16)." must_say=["int64|values are right", "uint8|uint16"] kind="dtype"
def decode(message):
    h, w, step = message.height, message.width, message.step
    data = list(message.data)
    if message.encoding == "mono8":
        return np.array([[data[y * step + x] for x in range(w)] for y in range(h)])
    if message.encoding == "mono16":
        big, small = (256, 1) if message.is_bigendian else (1, 256)
        return np.array([[data[y * step + 2 * x] * big + data[y * step + 2 * x + 1] * small for x in range(w)] for y in range(h)])
    return np.array([[data[y * step + 3 * x : y * step + 3 * x + 3] for x in range(w)] for y in range(h)])

# %% name="bytes joined in uint8" origin="new" sentence="A uint8 value times 256 runs past 255 and wraps around: widen the bytes with astype(np.uint16) before you put the two together." must_say=["wrap|past 255|overflow|does not fit|shift", "widen|astype|uint16"] kind="value"
def decode(message):
    h, w = message.height, message.width
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)
    if message.encoding == "mono8":
        return rows[:, :w]
    if message.encoding == "mono16":
        first, second = rows[:, 0 : 2 * w : 2], rows[:, 1 : 2 * w : 2]
        if message.is_bigendian:
            return ((first << 8) + second).astype(np.uint16)
        return ((second << 8) + first).astype(np.uint16)
    return rows[:, : 3 * w].reshape(h, w, 3)

# %% name="only mono8 is handled" origin="new" sentence="You decode every message as mono8, one byte a pixel: look at message.encoding, because rgb8 and bgr8 take three bytes and mono16 two." must_say=["every message|one byte|message\\.encoding|look at .*encoding|always", "rgb8|mono16|three|colou?r|encoding"] kind="shape"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, : message.width]

# %% name="encoding compared with a set of letters" origin="new" sentence="encoding == \"rgb8\" or \"bgr8\" is always true, because a text that is not empty counts as True: compare each of them, or write in (\"rgb8\", \"bgr8\")." must_say=["always|\\bor\\b|true", "compar|\\bin\\b|each|=="] kind="error"
def decode(message):
    h, w = message.height, message.width
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)
    if message.encoding == "rgb8" or "bgr8":
        return rows[:, : 3 * w].reshape(h, w, 3)
    elif message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.ascontiguousarray(rows[:, : 2 * w]).view(order).astype(np.uint16)
    return rows[:, :w]

# %% name="crop before the pixels are formed" origin="new" sentence="You crop the mono16 row to width bytes, but each pixel takes two: crop at width * 2 bytes." must_say=["two|\\b2\\b", "crop|width ?(\\*|×) ?2|half|too few"] kind="shape"
def decode(message):
    h, w = message.height, message.width
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        half = np.ascontiguousarray(rows[:, : w // 2 * 2])
        return half.view(order).astype(np.uint16)
    if message.encoding == "mono8":
        return rows[:, :w]
    return rows[:, : 3 * w].reshape(h, w, 3)

# %% name="message used like a dictionary" origin="new" sentence="A message has fields, not keys: write message.height instead of message[\"height\"]." must_say=["field|attribute|dot|subscript", "message\\.|dictionary|key|bracket"] kind="error"
def decode(message):
    rows = np.frombuffer(message["data"], np.uint8).reshape(message["height"], message["step"])
    return rows[:, : message["width"]]

# %% name="result only in a name" origin="new" sentence="The array is stored in image, but the function ends without return: give image back." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def decode(message):
    h, w = message.height, message.width
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)
    if message.encoding == "mono8":
        image = rows[:, :w]
    elif message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        image = np.ascontiguousarray(rows[:, : 2 * w]).view(order).astype(np.uint16)
    else:
        image = rows[:, : 3 * w].reshape(h, w, 3)

# %% name="the lesson's tiny message decoded" origin="new" sentence="You decode tiny_message of an earlier cell, not the message that your function receives: use the parameter message everywhere." must_say=["tiny_message|another cell|other cell|earlier cell", "message|argument|parameter"] kind="other-cell"
def decode(message):
    flat = np.frombuffer(tiny_message.data, dtype=np.uint8)
    return flat.reshape(tiny_message.height, tiny_message.step)

# %% name="bgr8 forgotten" origin="new" sentence="bgr8 has three channels like rgb8, and your function treats it like mono8: add bgr8 to the colour case." must_say=["bgr8", "three|rgb8|colou?r|channel"] kind="shape"
def decode(message):
    h, w = message.height, message.width
    rows = np.frombuffer(message.data, np.uint8).reshape(h, message.step)
    if message.encoding == "rgb8":
        return rows[:, : 3 * w].reshape(h, w, 3)
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.ascontiguousarray(rows[:, : 2 * w]).view(order).astype(np.uint16)
    return rows[:, :w]
