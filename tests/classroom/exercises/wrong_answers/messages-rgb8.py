# %% name="channels left out of the shape" origin="new" sentence="A colour pixel has three bytes, so the shape needs the channels: reshape to (height, width, 3)." must_say=["three|\\b3\\b", "channel|byte|shape|reshape"] kind="error"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width)

# %% name="channels first" origin="new" sentence="The three bytes of a pixel stand side by side, so the channels are the last axis: (height, width, 3), not (3, height, width)." must_say=["channel|plane|colou?r", "first|side by side|together|last"] kind="shape"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(3, message.height, message.width)

# %% name="three planes, then moved" origin="new" sentence="data does not hold one plane for each colour: the three bytes of a pixel stand side by side, so reshape(height, width, 3) is enough, without transpose." must_say=["plane|side by side|next to|together|transpos", "pixel|reshape|channel"] kind="value"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    planes = flat.reshape(3, message.height, message.width)
    return planes.transpose(1, 2, 0)

# %% name="width before height" origin="new" sentence="The shape begins with the rows: (height, width, 3), not (width, height, 3)." must_say=["height", "width|rows", "first|swap|exchang|begin|wrong way|not \\(width"] kind="shape"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.width, message.height, 3)

# %% name="channels reversed always" origin="new" sentence="You turned the channels around, but the task wants them in the order of data: leave [..., ::-1] out." must_say=["channel|red and blue|::-1", "order|revers|swap|as they|leave|turn"] kind="value"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width, 3)[..., ::-1]

# %% name="bgr8 made to rgb" origin="new" sentence="You turn bgr8 into red, green, blue, but the task wants the channels in the order of data for both encodings." must_say=["bgr8|channel|red and blue", "order|revers|swap|as they|leave|turn"] kind="value"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width, 3)
    if message.encoding == "bgr8":
        image = image[:, :, ::-1]
    return image

# %% name="rgb8 made to bgr" origin="new" sentence="You turn rgb8 into blue, green, red, but the task wants the channels in the order of data for both encodings." must_say=["rgb8|channel|red and blue", "order|revers|swap|as they|leave|turn"] kind="value"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width, 3)
    if message.encoding == "rgb8":
        return image[:, :, ::-1]
    return image

# %% name="two dimensions" origin="new" sentence="The result is (height, 3 × width) without an axis for the channels: reshape to (height, width, 3)." must_say=["channel|axis|dimension", "height, width, 3|third|last axis|reshape"] kind="shape"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width * 3)

# %% name="one pixel a row" origin="new" sentence="reshape(-1, 3) gives one pixel in each row: the shape needs the rows and columns of the image too, (height, width, 3)." must_say=["height, width, 3|height|rows", "reshape|shape|dimension|axis"] kind="shape"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(-1, 3)

# %% name="only one channel" origin="new" sentence="You return one channel of three, and the task wants all of them: shape (height, width, 3)." must_say=["channel", "all|three|one|only"] kind="shape"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width, 3)
    return image[:, :, 0]

# %% name="upside down" origin="new" sentence="The first row of data is the top row of the image, and you turned the rows around: leave [::-1] out." must_say=["row|upside|top|bottom", "revers|around|upside|order|last"] kind="value"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width, 3)[::-1]

# %% name="columns reversed instead of channels" origin="new" sentence="[:, ::-1] turns the columns around, so the image is mirrored: the task wants the pixels as they lie in data." must_say=["column|mirror|left", "revers|around|mirror|as they|order"] kind="value"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width, 3)[:, ::-1]

# %% name="return forgotten" origin="new" sentence="The array is stored in image, but the function ends without return: give image back." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width, 3)

# %% name="only rgb8 answered" origin="new" sentence="For bgr8 your if is false, so the function ends without return and gives None: bgr8 is decoded in the same way." must_say=["None|no return|without (a )?return|nothing|missing", "bgr8|both|last case|else"] kind="no-return"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    if message.encoding == "rgb8":
        return flat.reshape(message.height, message.width, 3)

# %% name="field that a message does not have" origin="new" sentence="A message has no field channels: the encoding says the number of channels, 3 for rgb8 and bgr8." must_say=["channels|no attribute|has no", "\\b3\\b|encoding|field|three"] kind="error"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width, message.channels)

# %% name="the camera's size" origin="new" sentence="(720, 1280, 3) is right only for the robot's camera: take the numbers from message.height and message.width." must_say=["720|fixed|other|any size|cannot reshape", "height|width|size"] kind="error"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(720, 1280, 3)

# %% name="lists of pixels" origin="new" sentence="You return lists, and an array was asked for: wrap them in np.array(..., dtype=np.uint8)." must_say=["\\blists?\\b", "array"] kind="type"
def decode_rgb8(message):
    image = []
    for row in range(message.height):
        pixels = []
        for column in range(message.width):
            position = row * message.step + column * 3
            pixels.append(list(message.data[position : position + 3]))
        image.append(pixels)
    return image

# %% name="position without three bytes a pixel" origin="new" sentence="Column c begins at byte c * 3 of its row, because every pixel takes three bytes; you step by one." must_say=["three|\\b3\\b", "column|pixel|byte"] kind="value"
def decode_rgb8(message):
    image = np.zeros((message.height, message.width, 3), dtype=np.uint8)
    for row in range(message.height):
        for column in range(message.width):
            for channel in range(3):
                image[row, column, channel] = message.data[row * message.step + column + channel]
    return image

# %% name="OpenCV converts" origin="new" sentence="cv2 is refused in this task: np.frombuffer and reshape are enough." must_say=["cv2|opencv", "refus|not allowed|numpy|frombuffer|forbid"] kind="refused"
import cv2


def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width, 3)
    return cv2.cvtColor(cv2.cvtColor(image, cv2.COLOR_RGB2BGR), cv2.COLOR_BGR2RGB)

# %% name="gray instead of colour" origin="new" sentence="You take the mean of the channels, which makes a gray image: return all three channels." must_say=["mean|gray|average", "three|all|channel"] kind="shape"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width, 3)
    return image.mean(axis=-1).astype(np.uint8)
