# %% name="one long row" sentence="The result has one dimension, all rows one after the other: cut it into rows with reshape(height, width)." must_say=["reshape", "dimension|rows|height"] kind="shape"
def decode_mono8(message):
    return np.frombuffer(message.data, dtype=np.uint8)

# %% name="list of the bytes" sentence="You return a list of numbers, and an array was asked for: np.frombuffer makes an array of the bytes, reshape cuts it into rows." must_say=["\\blist\\b", "array"] kind="type"
def decode_mono8(message):
    return list(message.data)

# %% name="upside down" sentence="The first row of data is the top row of the image, and you turned the rows around: leave [::-1] out." must_say=["row|upside|top|bottom", "revers|around|upside|order|last"] kind="value"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width)[::-1]

# %% name="np.array of the bytes" sentence="np.array(message.data) makes one single object of the bytes, not their numbers: np.frombuffer(message.data, dtype=np.uint8) reads them." must_say=["frombuffer|list\\(", "np\\.array|single|object|one value"] kind="error"
def decode_mono8(message):
    pixels = np.array(message.data)
    return pixels.reshape(message.height, message.width)
