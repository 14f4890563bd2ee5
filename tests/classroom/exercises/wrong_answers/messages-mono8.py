# %% name="width before height" origin="new" sentence="The shape begins with the number of rows: reshape to (height, width), not (width, height)." must_say=["height", "width|rows", "first|swap|exchang|begin|wrong way|not \\(width"] kind="shape"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.width, message.height)

# %% name="width before height, then transposed" origin="new" sentence="You cut rows of height bytes and then turn the image: cut rows of width bytes with reshape(height, width), and do not transpose." must_say=["transpos|\\.T\\b|columns|turn", "height|width|rows"] must_not_say=["endian"] kind="value"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.width, message.height).T

# %% name="one long row" origin="new" sentence="The result has one dimension, all rows one after the other: cut it into rows with reshape(height, width)." must_say=["reshape", "dimension|rows|height"] kind="shape"
def decode_mono8(message):
    return np.frombuffer(message.data, dtype=np.uint8)

# %% name="return forgotten" origin="new" sentence="The array is stored in image, but the function ends without return: give image back." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    image = flat.reshape(message.height, message.width)

# %% name="printed only" origin="new" sentence="Your function prints the array and returns nothing: replace print by return." must_say=["return", "print|None|nothing"] kind="no-return"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    print(flat.reshape(message.height, message.width))

# %% name="list of the bytes" origin="new" sentence="You return a list of numbers, and an array was asked for: np.frombuffer makes an array of the bytes, reshape cuts it into rows." must_say=["\\blist\\b", "array"] kind="type"
def decode_mono8(message):
    return list(message.data)

# %% name="list of lists from a loop" origin="new" sentence="You return a list of lists, and an array was asked for: wrap it in np.array(..., dtype=np.uint8)." must_say=["\\blists?\\b", "array"] kind="type"
def decode_mono8(message):
    rows = []
    for row in range(message.height):
        start = row * message.width
        rows.append(list(message.data[start : start + message.width]))
    return rows

# %% name="int64 from the list" origin="new" sentence="The values are right, but np.array makes int64 of Python numbers: give the dtype, np.array(rows, dtype=np.uint8)." must_say=["int64|values are right", "uint8"] kind="dtype"
def decode_mono8(message):
    rows = []
    for row in range(message.height):
        start = row * message.width
        rows.append(list(message.data[start : start + message.width]))
    return np.array(rows)

# %% name="np.array of the bytes" origin="new" sentence="np.array(message.data) makes one single object of the bytes, not their numbers: np.frombuffer(message.data, dtype=np.uint8) reads them." must_say=["frombuffer|list\\(", "np\\.array|single|object|one value"] kind="error"
def decode_mono8(message):
    pixels = np.array(message.data)
    return pixels.reshape(message.height, message.width)

# %% name="dtype left out" origin="new" sentence="Without dtype, np.frombuffer reads floating-point numbers of eight bytes: write dtype=np.uint8." must_say=["dtype", "uint8|float|eight|\\b8\\b"] kind="error"
def decode_mono8(message):
    flat = np.frombuffer(message.data)
    return flat.reshape(message.height, message.width)

# %% name="dtype uint16" origin="new" sentence="A mono8 pixel takes one byte, and you read two bytes for each pixel: use dtype=np.uint8." must_say=["uint16|two bytes", "uint8|one byte"] kind="error"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint16)
    return flat.reshape(message.height, message.width)

# %% name="dtype int8" origin="new" sentence="int8 has a sign and ends at 127, so the bright pixels became negative: use dtype=np.uint8." must_say=["int8|sign|negative", "uint8"] kind="dtype"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.int8)
    return flat.reshape(message.height, message.width)

# %% name="five rows of five" origin="new" sentence="reshape(5, 5) is right only for the image of the lesson: take the numbers from message.height and message.width." must_say=["\\b5\\b|fixed|other|any size|lesson|cannot reshape", "height|width|size"] kind="error"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(5, 5)

# %% name="position with the height" origin="new" sentence="A row takes width bytes, so row r begins at r * width, not at r * height." must_say=["width", "height|step|begin|position|row"] kind="value"
def decode_mono8(message):
    image = np.zeros((message.height, message.width), dtype=np.uint8)
    for row in range(message.height):
        for column in range(message.width):
            image[row, column] = message.data[row * message.height + column]
    return image

# %% name="column by column" origin="new" sentence="The bytes are stored row after row, and you fill the columns first: leave order=\"F\" out." must_say=["row after row|rows? first|row by row|column", "order|fill|first|row"] kind="value"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape((message.height, message.width), order="F")

# %% name="a third axis" origin="new" sentence="A gray image has two dimensions, (height, width): leave the 1 at the end of the shape out." must_say=["two dimensions|\\(height, width\\)|axis|dimension", "\\b1\\b|third|leave|two|height, width"] kind="shape"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width, 1)

# %% name="the lesson's tiny message" origin="new" sentence="You decode tiny_message of an earlier cell, not the message that your function receives: use the parameter message." must_say=["tiny_message|another cell|other cell|earlier cell", "message|argument|parameter"] kind="other-cell"
def decode_mono8(message):
    flat = np.frombuffer(tiny_message.data, dtype=np.uint8)
    return flat.reshape(tiny_message.height, tiny_message.width)

# %% name="message used like a dictionary" origin="new" sentence="A message has fields, not keys: write message.height instead of message[\"height\"]." must_say=["field|attribute|dot|subscript", "message\\.|dictionary|key|bracket"] kind="error"
def decode_mono8(message):
    flat = np.frombuffer(message["data"], dtype=np.uint8)
    return flat.reshape(message["height"], message["width"])

# %% name="shape of a message" origin="new" sentence="A message has no shape, that is an array's: take the size from message.height and message.width." must_say=["shape", "height|no attribute|has no"] kind="error"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.shape)

# %% name="the course's converter" origin="new" sentence="image_to_array is refused in this task, because here you are the converter: use np.frombuffer and reshape." must_say=["image_to_array|converter|imgproc_course|course", "refus|not allowed|yourself|numpy|frombuffer|forbid"] kind="refused"
from imgproc_course.messages import image_to_array


def decode_mono8(message):
    return image_to_array(message)

# %% name="values between 0 and 1" origin="new" sentence="You divide by 255, and the task wants the gray levels as they are, uint8 from 0 to 255: leave the division out." must_say=["255|divi|between 0 and 1|0 to 1", "leave|uint8|as they are|without|not divide"] kind="dtype"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width) / 255

# %% name="upside down" origin="new" sentence="The first row of data is the top row of the image, and you turned the rows around: leave [::-1] out." must_say=["row|upside|top|bottom", "revers|around|upside|order|last"] kind="value"
def decode_mono8(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width)[::-1]
