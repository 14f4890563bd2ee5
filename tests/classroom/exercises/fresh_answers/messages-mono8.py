# %% name="width first" origin="fresh" sentence="reshape needs (height, width): rows first; you exchanged them." must_say=["height|rows|order|exchang|swap|first"] kind="shape"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.width, message.height)

# %% name="sizes of the tiny image" origin="fresh" sentence="5 × 5 is the size of tiny; take message.height and message.width." must_say=["message\\.(height|width)|any size|height|5"] kind="error"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    decoded = flat.reshape(5, 5)
    return decoded

# %% name="no dtype" origin="fresh" sentence="Without dtype, frombuffer reads 8 bytes as one float64: write dtype=np.uint8." must_say=["dtype|float64|float|8 bytes|uint8"] kind="error"
def decode_mono8(message):
    flat = np.frombuffer(message.data)
    return flat.reshape(message.height, message.width)

# %% name="reshape result is lost" origin="fresh" sentence="reshape gives a new array and does not change flat: return the result of reshape." must_say=["reshape|result|assign|new array|2|one long|rows"] must_not_say=["order|swap"] kind="shape"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    flat.reshape(message.height, message.width)
    return flat

# %% name="uses tiny_message" origin="fresh" sentence="You read tiny_message, the lesson's message, instead of the given message." must_say=["tiny_message|given|argument|parameter|lesson"] kind="value"
def decode_mono8(message):
    flat = np.frombuffer(tiny_message.data, dtype=np.uint8)
    return flat.reshape(tiny_message.height, tiny_message.width)

# %% name="Width and height are exchanged in reshape" origin="fresh" sentence="Width and height are exchanged in reshape." must_say=["exchanged"] kind="shape"
def decode_mono8(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    return values.reshape(message.width, message.height)

# %% name="reshape gives a new array but the result is thrown away" origin="fresh" sentence="reshape gives a new array but the result is thrown away, so the flat array is returned." must_say=["reshape"] kind="shape"
def decode_mono8(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    values.reshape(message.height, message.width)
    return values

# %% name="The size 5 x 5 of the example is hard-coded" origin="fresh" sentence="The size 5 x 5 of the example is hard-coded, so other sizes fail." must_say=["hard-coded|says 5"] kind="error"
def decode_mono8(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    return values.reshape(5, 5)

# %% name="The dtype is missing in frombuffer" origin="fresh" sentence="The dtype is missing in frombuffer, which then reads the bytes as float64." must_say=["dtype"] kind="error"
def decode_mono8(message):
    values = np.frombuffer(message.data)
    return values.reshape(message.height, message.width)

# %% name="Decodes the example tiny_message every time and ignores" origin="fresh" sentence="Decodes the example tiny_message every time and ignores the argument." must_say=["tiny_message"] kind="error"
def decode_mono8(message):
    values = np.frombuffer(tiny_message.data, dtype=np.uint8)
    return values.reshape(tiny_message.height, tiny_message.width)

# %% name="The result is stored in a variable but never returned" origin="fresh" sentence="The result is stored in a variable but never returned, so the function gives None." must_say=["return"] kind="no-return"
def decode_mono8(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    image = values.reshape(message.height, message.width)

# %% name="int8 is a signed type" origin="fresh" sentence="int8 is a signed type: gray levels above 127 become negative." must_say=["int8"] kind="dtype"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.int8)
    return flat.reshape(message.height, message.width)

# %% name="Gives the whole message to frombuffer instead of its field" origin="fresh" sentence="Gives the whole message to frombuffer instead of its field data." must_say=["\\bdata\\b"] kind="error"
def decode_mono8(message):
    values = np.frombuffer(message, dtype=np.uint8)
    return values.reshape(message.height, message.width)

# %% name="height and width are fields of the message" origin="fresh" sentence="height and width are fields of the message; without 'message.' the names do not exist." must_say=["height"] kind="error"
def decode_mono8(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    return values.reshape(height, width)

# %% name="Converts the pixels to int at the end" origin="fresh" sentence="Converts the pixels to int at the end, so the dtype is int64 and not uint8." must_say=["dtype|int64"] kind="dtype"
def decode_mono8(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    image = values.reshape(message.height, message.width)
    return image.astype(int)
