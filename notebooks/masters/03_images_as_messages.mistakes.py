# %% [markdown]
# # messages-padding

# %% role="mistake" name="padding read as pixels" says="The padding was read as pixels, so the image is sheared. First cut data into rows of step bytes, reshape(height, step), so that row r begins at byte r * step. Then crop the padding at the end of each row."
def decode_padded(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat[: message.height * message.width * 3].reshape(message.height, message.width, 3)

# %% role="mistake" name="padding kept" says="The padding is still in the array, at the end of each row. Keep only the first width * 3 columns, then reshape to (height, width, 3)."
def decode_padded(message):
    return np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)

# %% role="mistake" name="padding made black" says="The padding became 0, but it is still in the array. Cut it off with a slice: keep only the first width * 3 columns."
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step).copy()
    rows[:, message.width * 3 :] = 0
    return rows

# %% role="mistake" name="padding expected in front" says="The first bytes of each row were cut off. The padding is at the end of a row: keep the first width * 3 bytes."
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, message.step - message.width * 3 :].reshape(message.height, message.width, 3)

# %% role="mistake" name="always three bytes of padding" says="Only a padding of three bytes is removed correctly. Other messages have other paddings: step tells the length of a row. Keep the first width * 3 bytes of it."
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, :-3].reshape(message.height, message.width, 3)

# %% role="mistake" name="always one byte of padding" says="Only a padding of one byte is removed correctly. Other messages have other paddings: step tells the length of a row. Keep the first width * 3 bytes of it."
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, :-1].reshape(message.height, message.width, 3)

# %% role="mistake" name="whole pixels cropped" says="It works only if the padding is a multiple of three bytes. The padding need not be a whole pixel: crop the bytes of each row first, and form the pixels after that."
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, -1, 3)
    return rows[:, : message.width]

# %% role="mistake" name="rows and columns exchanged" says="Height and width are exchanged. The first axis of an array is its rows, so the shape is (height, width, 3), and height comes first."
def decode_padded(message):
    return solution(message).reshape(message.width, message.height, 3)

# %% [markdown]
# # messages-mono16

# %% role="mistake" name="byte orders swapped" says="The two byte orders are swapped. If is_bigendian is 1, the more significant byte comes first (in a dtype: >u2). If it is 0, the less significant byte comes first (<u2)."
def decode_mono16(message):
    return solution(message).byteswap()

# %% role="mistake" name="a pixel for every byte, as uint16" says="Every byte became a pixel. A pixel of mono16 takes two bytes: combine two bytes to one uint16 number."
def decode_mono16(message):
    return np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step).astype(np.uint16)

# %% role="mistake" name="half of the bytes" says="Every byte became a pixel, and half of them were cut off. A pixel of mono16 takes two bytes: combine two bytes to one uint16 number."
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, : message.width]

# %% role="mistake" name="only the less significant byte" says="Only the less significant byte is left. If you moved the other byte with << 8 while it was uint8: it does not fit, and uint8 wraps to 0. Widen both bytes first, with astype(np.uint16)."
def decode_mono16(message):
    return solution(message) & 255

# %% role="mistake" name="255 instead of 256" says="The more significant byte was multiplied by 255. A byte has 256 different values, from 0 to 255, so multiply it by 256."
def decode_mono16(message):
    return (solution(message) >> 8) * 255 + (solution(message) & 255)

# %% role="mistake" name="bytes added" says="The two bytes were only added. The more significant byte counts 256 times as much: multiply it by 256 before you add the other byte."
def decode_mono16(message):
    return (solution(message) >> 8) + (solution(message) & 255)

# %% role="mistake" name="one byte from each half of a row" says="Each pixel was combined from one byte of the left half of the row and one of the right half. The two bytes of a pixel are side by side: use the slices 0::2 and 1::2."
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step).astype(np.uint16)
    left, right = rows[:, : message.width], rows[:, message.width :]
    return left * 256 + right if message.is_bigendian else right * 256 + left

# %% role="mistake" name="only two columns" says="Only the first bytes of each row are left. The slice 0:2 takes the columns 0 and 1; 0::2 takes every second column: the first byte of each pixel."
def decode_mono16(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, 0:2].reshape(message.height, message.width)

# %% role="mistake" name="not cut into rows" says="The array has only one dimension. Cut it into rows: reshape(height, width)."
def decode_mono16(message):
    return solution(message).ravel()

# %% [markdown]
# # messages-decode

# %%
def rows_of(message):
    return np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)

# %% role="mistake" name="channels swapped" says="Red and blue are swapped. The channels must be in the same order as in data."
def decode(message):
    return solution(message)[..., ::-1] if message.encoding in ("rgb8", "bgr8") else solution(message)

# %% role="mistake" name="bgr8 reordered" says="For bgr8, red and blue are swapped. Keep the channels in the order of data, for rgb8 and for bgr8."
def decode(message):
    return solution(message)[..., ::-1] if message.encoding == "bgr8" else solution(message)

# %% role="mistake" name="every message decoded as mono8" says="Every message was decoded like mono8, with one byte per pixel. Look at message.encoding: rgb8 and bgr8 take three bytes per pixel, mono16 takes two."
def decode(message):
    return rows_of(message)[:, : message.width]

# %% role="mistake" name="colour decoded as gray" says="The colour images were decoded with one byte per pixel, like mono8. rgb8 and bgr8 have three channels: crop at width * 3 bytes, and reshape to (height, width, 3)."
def decode(message):
    return rows_of(message)[:, : message.width] if solution(message).ndim == 3 else solution(message)

# %% role="mistake" name="bgr8 decoded as gray" says="The bgr8 image was decoded with one byte per pixel, like mono8. bgr8 has three channels, like rgb8: decode both in the same way."
def decode(message):
    return rows_of(message)[:, : message.width] if message.encoding == "bgr8" else solution(message)

# %% role="mistake" name="mono16 decoded as mono8" says="For mono16, every byte became a pixel. A pixel takes two bytes: read or combine them as uint16, with the byte order that is_bigendian gives."
def decode(message):
    return rows_of(message)[:, : message.width] if message.encoding == "mono16" else solution(message)

# %% role="mistake" name="two columns for each pixel of mono16" says="For mono16, every byte became a pixel, so there are twice as many columns. A pixel takes two bytes: read or combine them as uint16."
def decode(message):
    return rows_of(message)[:, : message.width * 2] if message.encoding == "mono16" else solution(message)

# %% role="mistake" name="half of the columns of mono16" says="The mono16 image has only half of its columns. A pixel takes two bytes: crop each row at width * 2 bytes."
def decode(message):
    return solution(message)[:, : message.width // 2] if message.encoding == "mono16" else solution(message)

# %% role="mistake" name="only the less significant byte" says="Of each mono16 pixel only the less significant byte is left. If you moved the other byte with << 8 while it was uint8: it does not fit, and uint8 wraps to 0. Widen both bytes first, with astype(np.uint16)."
def decode(message):
    return solution(message) & np.uint16(255) if message.encoding == "mono16" else solution(message)

# %% role="mistake" name="bytes added" says="The two bytes of a mono16 pixel were only added. The more significant byte counts 256 times as much: multiply it by 256 before you add the other byte."
def decode(message):
    pixels = solution(message)
    return (pixels >> 8) + (pixels & 255) if message.encoding == "mono16" else pixels

# %% role="mistake" name="always little-endian" says="The bytes of the big-endian message were read in the wrong order. is_bigendian says which byte comes first: 1 means the more significant one."
def decode(message):
    return solution(message).byteswap() if message.is_bigendian else solution(message)

# %% role="mistake" name="always big-endian" says="The bytes of the little-endian message were read in the wrong order. is_bigendian says which byte comes first: 0 means the less significant one."
def decode(message):
    return solution(message) if message.is_bigendian else solution(message).byteswap()

# %% role="mistake" name="byte orders swapped" says="The two byte orders are swapped. If is_bigendian is 1, the more significant byte comes first (in a dtype: >u2). If it is 0, the less significant byte comes first (<u2)."
def decode(message):
    return solution(message).byteswap()
