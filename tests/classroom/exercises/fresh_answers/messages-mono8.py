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
