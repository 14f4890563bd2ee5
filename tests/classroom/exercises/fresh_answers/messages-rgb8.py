# %% name="three planes" origin="fresh" sentence="The channels stand side by side in each pixel: the shape is (height, width, 3), the 3 at the end." must_say=["3\\)|last|end|height, ?width|order|shape"] kind="shape"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(3, message.height, message.width)

# %% name="forgets the 3" origin="fresh" sentence="Each pixel has three bytes: reshape to (height, width, 3)." must_say=["3 (bytes|channels|values)|three|channels?|, 3\\)"] kind="error"
def decode_rgb8(message):
    pixels = np.frombuffer(message.data, dtype=np.uint8)
    return pixels.reshape(message.height, message.width)

# %% name="repairs red and blue" origin="fresh" sentence="The channels must keep the order of data; you reverse them." must_say=["order|revers|swap|::-1|exchang|channels"] kind="value"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width, 3)
    if message.encoding == "bgr8":
        image = image[..., ::-1]
    return image

# %% name="step as columns" origin="fresh" sentence="step is the number of bytes of a row, not of pixels: use width." must_say=["step|width|bytes"] kind="error"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.step, 3)

# %% name="swapped height and width" origin="fresh" sentence="Rows come first: (height, width, 3)." must_say=["height|rows|order|swap|exchang|first"] must_not_say=["channel"] kind="shape"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape((message.width, message.height, 3))
