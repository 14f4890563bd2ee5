# %% name="channels left out of the shape" sentence="A colour pixel has three bytes, so the shape needs the channels: reshape to (height, width, 3)." must_say=["three|\\b3\\b", "channel|byte|shape|reshape"] kind="error"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width)

# %% name="channels reversed always" sentence="You turned the channels around, but the task wants them in the order of data: leave [..., ::-1] out." must_say=["channel|red and blue|::-1", "order|revers|swap|as they|leave|turn"] kind="value"
def decode_rgb8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width, 3)[..., ::-1]
