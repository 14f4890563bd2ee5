# %% name="always little-endian" sentence="You always read the less significant byte first; where is_bigendian is 1 the more significant byte comes first, so use the field." must_say=["endian|byte order|significant", "is_bigendian|>u2|field"] kind="value"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype="<u2")
    return flat.reshape(message.height, message.width)
