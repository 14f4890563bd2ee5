# %% name="cropped at width bytes, no channels" sentence="You keep width bytes of each row and return one number for a pixel: a pixel has three bytes, so crop at width * 3 and reshape to (height, width, 3)." must_say=["\\b3\\b|three", "crop|reshape|byte|channel"] kind="shape"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, : message.width]

# %% name="the lesson's padded message" sentence="You decode padded of an earlier cell, not the message that your function receives: use the parameter message." must_say=["padded|another cell|other cell|earlier cell", "message|argument|parameter"] kind="other-cell"
def decode_padded(message):
    rows = np.frombuffer(padded.data, dtype=np.uint8).reshape(padded.height, padded.step)
    return rows[:, : padded.width * 3].reshape(padded.height, padded.width, 3)
