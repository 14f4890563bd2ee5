# %% name="the lesson's padded message" sentence="You decode padded of an earlier cell, not the message that your function receives: use the parameter message." must_say=["padded|another cell|other cell|earlier cell", "message|argument|parameter"] kind="other-cell"
def decode_padded(message):
    rows = np.frombuffer(padded.data, dtype=np.uint8).reshape(padded.height, padded.step)
    return rows[:, : padded.width * 3].reshape(padded.height, padded.width, 3)
