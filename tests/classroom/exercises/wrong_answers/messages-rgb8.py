# %% name="swapped height and width" sentence="Rows come first: (height, width, 3)." must_say=["height|rows|order|swap|exchang|first"] must_not_say=["channel"] kind="shape"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape((message.width, message.height, 3))

# %% name="channels left out of the shape" sentence="A colour pixel has three bytes, so the shape needs the channels: reshape to (height, width, 3)." must_say=["three|\\b3\\b", "channel|byte|shape|reshape"] kind="error"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width)

# %% name="channels reversed always" sentence="You turned the channels around, but the task wants them in the order of data: leave [..., ::-1] out." must_say=["channel|red and blue|::-1", "order|revers|swap|as they|leave|turn"] kind="value"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width, 3)[..., ::-1]

# %% name="return forgotten" sentence="The array is stored in image, but the function ends without return: give image back." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width, 3)

# %% name="OpenCV converts" sentence="cv2 is refused in this task: np.frombuffer and reshape are enough." must_say=["cv2|opencv", "refus|not allowed|numpy|frombuffer|forbid"] kind="refused"
import cv2


def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width, 3)
    return cv2.cvtColor(cv2.cvtColor(image, cv2.COLOR_RGB2BGR), cv2.COLOR_BGR2RGB)
