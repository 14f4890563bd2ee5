# %% name="plain average in uint8" origin="walk" sentence="You take the plain average, and luma needs the weights of blue, green and red; besides, the uint8 sum runs past 255, so widen first." must_say=["average|mean", "weight"] kind="value"
def luma(bgr):
    return (bgr[..., 0] + bgr[..., 1] + bgr[..., 2]) // 3

# %% name="uint16 overflows" origin="walk" sentence="uint16 ends at 65535 and 255 * 19235 does not fit: widen with astype(np.uint32)." must_say=["uint16|65535", "uint32|int32|int64|wider"] must_not_say=["channel comes first", "average"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint16)
    return ((wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798 + 2**14) >> 15).astype(np.uint8)

# %% name="bgr[0] for blue" origin="walk" sentence="bgr[0] is the first row of the image, not the blue channel: the channels are the last axis, so write bgr[..., 0]." must_say=["bgr\\[0\\]|first row|is (the|a) row|rows?,", "last|\\.\\.\\.|\\[:, ?:|channel|axis"] kind="shape"
def luma(bgr):
    b, g, r = bgr[0].astype(np.uint32), bgr[1].astype(np.uint32), bgr[2].astype(np.uint32)
    return ((b * 3735 + g * 19235 + r * 9798 + 2**14) >> 15).astype(np.uint8)

# %% name="decimal weights rounded" origin="walk" sentence="The formula is right, but with 0.114, 0.587 and 0.299 a few values round the other way: use the whole-number weights 3735, 19235 and 9798 of section 4." must_say=["round|decimal|fraction|few|exact", "3735|whole|integer|section 4"] must_not_say=["truncat", "channel"] kind="value"
def luma(bgr):
    b, g, r = bgr[..., 0], bgr[..., 1], bgr[..., 2]
    return np.round(0.114 * b + 0.587 * g + 0.299 * r).astype(np.uint8)

# %% name="float result" origin="walk" sentence="Your result is float, and uint8 was asked for: round it and end with .astype(np.uint8)." must_say=["float", "astype|uint8"] kind="dtype"
def luma(bgr):
    wide = bgr.astype(float)
    return np.floor((wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798 + 2**14) / 2**15)

# %% name="weights of red and blue swapped" origin="new" sentence="Blue is the first channel here, and you give it red's weight: the weights must stand in the order blue, green, red." must_say=["\\bblue\\b", "\\bred'?s?\\b", "blue (is|comes|stands)[^.]*first|blue first|order|swap|exchang|wrong way|channel 0|weight of red|red's weight"] must_not_say=["wrap"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    return ((wide[..., 0] * 9798 + wide[..., 1] * 19235 + wide[..., 2] * 3735 + 2**14) >> 15).astype(np.uint8)

# %% name="truncated, not rounded" origin="new" sentence=">> 15 drops the rest instead of rounding: add half of 32768, that is 2**14, before the shift." must_say=["round|truncat|drop", "half|2\\*\\*14|16384"] must_not_say=["wrap"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    return ((wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798) >> 15).astype(np.uint8)

# %% name="weights add up to 32769" origin="new" sentence="3736, 19235 and 9798 add up to 32769, one too many: blue's weight is 3735." must_say=["3735|3736|32769|one too many", "blue|add up|sum|3736|32769"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    return ((wide[..., 0] * 3736 + wide[..., 1] * 19235 + wide[..., 2] * 9798 + 2**14) >> 15).astype(np.uint8)

# %% name="average, widened" origin="new" sentence="This is the plain average of the three channels; luma weighs green most and blue least, so use the weights of section 4." must_say=["average|mean|same weight|equal", "weigh"] must_not_say=["wrap", "overflow", "255"] kind="value"
def luma(bgr):
    return (bgr.astype(np.uint16).sum(axis=-1) // 3).astype(np.uint8)

# %% name="mean over the wrong axis" origin="new" sentence="sum(axis=0) adds along the rows and loses the height: the channels are the last axis, axis=-1." must_say=["\\baxis ?=|wrong axis|axis 0|along the rows", "last|-1|channel|axis ?= ?2"] kind="shape"
def luma(bgr):
    weights = np.array([3735, 19235, 9798])
    return ((bgr * weights).sum(axis=0) + 2**14 >> 15).astype(np.uint8)

# %% name="weights as uint8 multiplication" origin="walk" sentence="3735 does not fit into uint8, the dtype of your channels: widen them with astype(np.uint32) before you multiply." must_say=["3735|19235|9798|multipl", "uint8|fit|overflow|255", "widen|astype|uint32|int"] must_not_say=["uint16"] kind="error"
def luma(bgr):
    return (bgr[..., 0] * 3735 + bgr[..., 1] * 19235 + bgr[..., 2] * 9798 + 2**14) >> 15

# %% name="narrowed after the sum, before the shift" origin="new" sentence="You narrow to uint8 before the division, so the sum is cut to its last eight bits: shift by 15 first, and narrow last." must_say=["narrow|astype|uint8", "shift|divi", "first|last|before|too early|order"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    total = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798 + 2**14
    return total.astype(np.uint8) >> 15

# %% name="shift binds weaker than plus" origin="new" sentence="+ is computed before >>, so you add 2**14 to the number 15 and shift too far: put the sum in parentheses, then shift." must_say=["parenthes|bracket|number 15|too far|before >>|order|preced", ">>|shift"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    total = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
    return (total >> 15 + 2**14).astype(np.uint8)

# %% name="uint32 result, not narrowed" origin="new" sentence="The values are right, but the dtype is still uint32: end with .astype(np.uint8)." must_say=["uint32", "uint8"] must_not_say=["weight", "round"] kind="dtype"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    return (wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798 + 2**14) >> 15

# %% name="cv2 does it" origin="new" sentence="cv2 is refused in this task: compute the weighted sum with NumPy." must_say=["cv2|opencv", "refus|not allowed|yourself|forbid"] kind="refused"
import cv2


def luma(bgr):
    return cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY)

# %% name="the course's to_gray" origin="new" sentence="to_gray is the course's own function and is refused here: write the weighted sum yourself." must_say=["to_gray|imgproc_course|course", "refus|not allowed|yourself|forbid"] kind="refused"
from imgproc_course.imaging import to_gray


def luma(bgr):
    return to_gray(bgr)

# %% name="PIL copied from the web" origin="new" sentence="Image.fromarray takes the channels as red, green, blue, but your frame has blue first; compute the weighted sum with NumPy instead." must_say=["PIL|pillow|fromarray|convert|red, green, blue", "numpy|blue|weight|order|yourself"] kind="value"
from PIL import Image


def luma(bgr):
    return np.array(Image.fromarray(bgr).convert("L"))

# %% name="one pixel of the lesson" origin="new" sentence="You compute the single pixel of section 1 with its numbers typed in: use the channels bgr[..., 0], bgr[..., 1] and bgr[..., 2] of the whole frame." must_say=["one pixel|single|typed|hard|fixed|same number|section 1", "bgr|channel|frame|argument|image"] kind="type"
def luma(bgr):
    blue, green, red = 30, 60, 220
    return (blue * 3735 + green * 19235 + red * 9798 + 2**14) >> 15

# %% name="loop writes a list" origin="walk" sentence="You return a list of lists, and an array was asked for: put the values into np.array(rows, dtype=np.uint8)." must_say=["\\blists?\\b", "array"] kind="type"
def luma(bgr):
    rows = []
    for y in range(bgr.shape[0]):
        row = []
        for x in range(bgr.shape[1]):
            b, g, r = (int(v) for v in bgr[y, x])
            row.append((b * 3735 + g * 19235 + r * 9798 + 2**14) >> 15)
        rows.append(row)
    return rows

# %% name="loop with rows and columns swapped" origin="new" sentence="In bgr[x, y] the column stands first, but an array is indexed rows first: write bgr[y, x]." must_say=["\\[y, ?x\\]|\\[x, ?y\\]|rows first|column", "first|swap|order|index|\\[y, ?x\\]"] kind="error"
def luma(bgr):
    height, width = bgr.shape[:2]
    gray = np.zeros((height, width), np.uint8)
    for y in range(height):
        for x in range(width):
            b, g, r = (int(v) for v in bgr[x, y])
            gray[x, y] = (b * 3735 + g * 19235 + r * 9798 + 2**14) >> 15
    return gray

# %% name="three channels kept" origin="new" sentence="Your result still has three channels: luma is one number per pixel, so add the three weighted channels up." must_say=["three channels|\\b3\\b|still|shape", "add|\\bsum\\b|one (number|value|channel)"] kind="shape"
def luma(bgr):
    weights = np.array([3735, 19235, 9798])
    return ((bgr * weights + 2**14) >> 15).astype(np.uint8)

# %% name="int() of an array" origin="new" sentence="int() takes one number and you give it a whole array: use .astype(np.uint8) to change the dtype of all values." must_say=["int\\(|one number|single|scalar", "astype"] kind="error"
def luma(bgr):
    b, g, r = bgr[..., 0], bgr[..., 1], bgr[..., 2]
    return int(0.114 * b + 0.587 * g + 0.299 * r)

# %% name="no return" origin="new" sentence="gray is computed and then lost, because the function has no return: end with return gray." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    gray = ((wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798 + 2**14) >> 15).astype(np.uint8)

# %% name="weights of another standard" origin="new" sentence="0.2126, 0.7152 and 0.0722 belong to another standard (BT.709): this lesson uses the weights of section 4, 3735, 19235 and 9798." must_say=["709|standard|0\\.2126|0\\.7152|0\\.0722|other weights|another", "3735|0\\.299|section 4|601|lesson"] kind="value"
def luma(bgr):
    b, g, r = bgr[..., 0], bgr[..., 1], bgr[..., 2]
    return np.round(0.0722 * b + 0.7152 * g + 0.2126 * r).astype(np.uint8)

# %% name="wide and sums of the lesson's cell" origin="new" sentence="sums belongs to another cell, where it was computed from another frame: compute it inside your function, from bgr." must_say=["another cell|other cell|sums", "bgr|inside|argument|your function"] kind="other-cell"
def luma(bgr):
    return ((sums + 2**14) >> 15).astype(np.uint8)
