# %% name="always little-endian" sentence="You always read the less significant byte first; where is_bigendian is 1 the more significant byte comes first, so use the field." must_say=["endian|byte order|significant", "is_bigendian|>u2|field"] kind="value"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype="<u2")
    return flat.reshape(message.height, message.width)

# %% name="signed numbers" sentence="i2 has a sign and ends at 32767, so large values became negative: use u2, unsigned." must_say=["sign|negative|int16|32767", "u2|uint16|unsigned"] kind="dtype"
def decode_mono16(message):
    dtype = ">i2" if message.is_bigendian else "<i2"
    return np.frombuffer(message.data, dtype=dtype).reshape(message.height, message.width)

# %% name="return only for big-endian" sentence="If is_bigendian is 0, your function ends without return and gives None: add the little-endian case." must_say=["None|no return|without (a )?return|nothing|missing", "little|is_bigendian|other case|else|last case"] kind="no-return"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    rows = rows.astype(np.uint16)
    if message.is_bigendian:
        return rows[:, 0::2] * 256 + rows[:, 1::2]
