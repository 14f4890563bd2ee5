# %% name="always little-endian" sentence="You always read the less significant byte first; where is_bigendian is 1 the more significant byte comes first, so use the field." must_say=["endian|byte order|significant", "is_bigendian|>u2|field"] kind="value"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype="<u2")
    return flat.reshape(message.height, message.width)

# %% name="signed numbers" sentence="i2 has a sign and ends at 32767, so large values became negative: use u2, unsigned." must_say=["sign|negative|int16|32767", "u2|uint16|unsigned"] kind="dtype"
def decode_mono16(message):
    dtype = ">i2" if message.is_bigendian else "<i2"
    return np.frombuffer(message.data, dtype=dtype).reshape(message.height, message.width)
