# %% name="the lesson's tiny message decoded" sentence="You decode tiny_message of an earlier cell, not the message that your function receives: use the parameter message everywhere." must_say=["tiny_message|another cell|other cell|earlier cell", "message|argument|parameter"] kind="other-cell"
def decode(message):
    flat = np.frombuffer(tiny_message.data, dtype=np.uint8)
    return flat.reshape(tiny_message.height, tiny_message.step)
