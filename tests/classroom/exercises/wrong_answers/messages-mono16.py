# %% name="always little-endian" origin="new" sentence="You always read the less significant byte first; where is_bigendian is 1 the more significant byte comes first, so use the field." must_say=["endian|byte order|significant", "is_bigendian|>u2|field"] kind="value"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype="<u2")
    return flat.reshape(message.height, message.width)

# %% name="always big-endian" origin="new" sentence="You always read the more significant byte first; where is_bigendian is 0 the less significant byte comes first, so use the field." must_say=["endian|byte order|significant", "is_bigendian|<u2|field"] kind="value"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype=">u2")
    return flat.reshape(message.height, message.width)

# %% name="byte orders swapped" origin="new" sentence="You have the two byte orders the wrong way round: > means big-endian, and belongs to is_bigendian = 1." must_say=["endian|byte order", "swap|exchang|wrong way|other way|revers|turned|>"] kind="value"
def decode_mono16(message):
    dtype = "<u2" if message.is_bigendian else ">u2"
    return np.frombuffer(message.data, dtype=dtype).reshape(message.height, message.width)

# %% name="bytes returned as pixels" origin="new" sentence="You return one pixel for every byte, and a mono16 pixel takes two bytes: put two bytes together." must_say=["two bytes|2 bytes|every byte|16 bit", "together|pixel|uint16|combine|pair"] kind="shape"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.step)

# %% name="not widened before the product" origin="new" sentence="256 does not fit into uint8: widen the bytes with astype(np.uint16) before you multiply." must_say=["uint8|does not fit|overflow", "widen|astype|uint16"] kind="error"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    first = rows[:, 0::2]
    second = rows[:, 1::2]
    if message.is_bigendian:
        return first * 256 + second
    return second * 256 + first

# %% name="shifted in uint8" origin="new" sentence="A uint8 value moved by 8 bits runs past 255 and nothing is left: widen the bytes with astype(np.uint16) first." must_say=["wrap|past 255|overflow|does not fit|shift|left", "widen|astype|uint16"] kind="value"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    first = rows[:, 0::2]
    second = rows[:, 1::2]
    if message.is_bigendian:
        pixels = (first << 8) + second
    else:
        pixels = (second << 8) + first
    return pixels.astype(np.uint16)

# %% name="narrowed at the end" origin="new" sentence="You put the right numbers together and then narrow them to uint8, so everything above 255 is lost: mono16 stays uint16." must_say=["uint8", "uint16", "lost|narrow|stays|keep|cut"] kind="dtype"
def decode_mono16(message):
    dtype = ">u2" if message.is_bigendian else "<u2"
    flat = np.frombuffer(message.data, dtype=dtype)
    return flat.reshape(message.height, message.width).astype(np.uint8)

# %% name="255 instead of 256" origin="new" sentence="A byte has 256 values, from 0 to 255, so the more significant byte counts 256, not 255." must_say=["256", "255"] kind="value"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    first = rows[:, 0::2].astype(np.uint16)
    second = rows[:, 1::2].astype(np.uint16)
    if message.is_bigendian:
        return first * 255 + second
    return second * 255 + first

# %% name="bytes added" origin="new" sentence="You add the two bytes, but the more significant one counts 256 times as much: multiply it by 256 first." must_say=["256", "add|multipl|times|sum|\\*"] kind="value"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    first = rows[:, 0::2].astype(np.uint16)
    second = rows[:, 1::2].astype(np.uint16)
    return first + second

# %% name="row cut in two halves" origin="new" sentence="The two bytes of a pixel stand side by side, and you take one from each half of the row: use the slices 0::2 and 1::2." must_say=["side by side|next to|half|together|0::2|every second", "byte|pixel|slice"] kind="value"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    rows = rows.astype(np.uint16)
    first = rows[:, : message.width]
    second = rows[:, message.width :]
    if message.is_bigendian:
        return first * 256 + second
    return second * 256 + first

# %% name="only the more significant byte" origin="new" sentence="You keep one byte of each pixel and drop the other one: the pixel is the more significant byte times 256 plus the other byte." must_say=["256|other byte|both bytes|second byte|less significant", "byte"] kind="value"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    start = 0 if message.is_bigendian else 1
    return rows[:, start::2].astype(np.uint16)

# %% name="int64 at the end" origin="new" sentence="The values are right, but the dtype is int64: end with astype(np.uint16)." must_say=["int64|values are right", "uint16"] kind="dtype"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    rows = rows.astype(int)
    if message.is_bigendian:
        return rows[:, 0::2] * 256 + rows[:, 1::2]
    return rows[:, 1::2] * 256 + rows[:, 0::2]

# %% name="signed numbers" origin="new" sentence="i2 has a sign and ends at 32767, so large values became negative: use u2, unsigned." must_say=["sign|negative|int16|32767", "u2|uint16|unsigned"] kind="dtype"
def decode_mono16(message):
    dtype = ">i2" if message.is_bigendian else "<i2"
    return np.frombuffer(message.data, dtype=dtype).reshape(message.height, message.width)

# %% name="one long row" origin="new" sentence="The result has one dimension: cut it into rows with reshape(height, width)." must_say=["reshape", "dimension|rows|height"] kind="shape"
def decode_mono16(message):
    dtype = ">u2" if message.is_bigendian else "<u2"
    return np.frombuffer(message.data, dtype=dtype)

# %% name="width before height" origin="new" sentence="The shape begins with the rows: (height, width), not (width, height)." must_say=["height", "width|rows", "first|swap|exchang|begin|wrong way|not \\(width"] kind="shape"
def decode_mono16(message):
    dtype = ">u2" if message.is_bigendian else "<u2"
    return np.frombuffer(message.data, dtype=dtype).reshape(message.width, message.height)

# %% name="return forgotten" origin="new" sentence="The array is stored in pixels, but the function ends without return: give it back." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    rows = rows.astype(np.uint16)
    if message.is_bigendian:
        pixels = rows[:, 0::2] * 256 + rows[:, 1::2]
    else:
        pixels = rows[:, 1::2] * 256 + rows[:, 0::2]

# %% name="return only for big-endian" origin="new" sentence="If is_bigendian is 0, your function ends without return and gives None: add the little-endian case." must_say=["None|no return|without (a )?return|nothing|missing", "little|is_bigendian|other case|else|last case"] kind="no-return"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    rows = rows.astype(np.uint16)
    if message.is_bigendian:
        return rows[:, 0::2] * 256 + rows[:, 1::2]

# %% name="field without message" origin="new" sentence="is_bigendian is a field of the message: write message.is_bigendian." must_say=["is_bigendian", "message|field|not defined"] kind="error"
def decode_mono16(message):
    dtype = ">u2" if is_bigendian else "<u2"
    return np.frombuffer(message.data, dtype=dtype).reshape(message.height, message.width)

# %% name="compared with a text" origin="new" sentence="is_bigendian is a number, 0 or 1, so it never equals the text \"1\": compare with 1, or write if message.is_bigendian." must_say=["endian|byte order|significant", "is_bigendian|number|text|field"] kind="value"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    rows = rows.astype(np.uint16)
    if message.is_bigendian == "1":
        return rows[:, 0::2] * 256 + rows[:, 1::2]
    return rows[:, 1::2] * 256 + rows[:, 0::2]

# %% name="step forgotten in the slice" origin="new" sentence="0:2 takes only the first two bytes of each row; 0::2 takes every second byte." must_say=["every second|0::2|::|two bytes|first (two|bytes)|colon", "byte|slice|column"] kind="error"
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    rows = rows.astype(np.uint16)
    first = rows[:, 0:2]
    second = rows[:, 1:2]
    pixels = first * 256 + second if message.is_bigendian else second * 256 + first
    return pixels.reshape(message.height, message.width)

# %% name="bytes widened one by one" origin="walk" sentence="A pixel takes two bytes: read both as one number." must_say=["two bytes|pixel"] kind="shape"
def decode_mono16(message):
    a = np.frombuffer(message.data, np.uint8).astype(np.uint16)
    return a.reshape(message.height, message.width * 2)
