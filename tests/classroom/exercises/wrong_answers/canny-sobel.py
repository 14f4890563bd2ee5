# %% name="interior only" origin="walk" sentence="The border stays 0, because your loop visits the inner pixels only: repeat the outermost rows and columns with np.pad(..., mode=\"edge\") and visit all." must_say=["border|outermost", "stays? 0|left (at )?0|are 0|inner|interior|left out|visit|never computed|not computed", "pad|repeat|replicat"] must_not_say=["swap", "along a row"] kind="value"
def my_sobel(gray):
    g = gray.astype(np.int32)
    row = np.zeros(gray.shape, np.int32)
    col = np.zeros(gray.shape, np.int32)
    for y in range(1, gray.shape[0] - 1):
        for x in range(1, gray.shape[1] - 1):
            col[y, x] = (g[y - 1, x + 1] + 2 * g[y, x + 1] + g[y + 1, x + 1]) - (g[y - 1, x - 1] + 2 * g[y, x - 1] + g[y + 1, x - 1])
            row[y, x] = (g[y + 1, x - 1] + 2 * g[y + 1, x] + g[y + 1, x + 1]) - (g[y - 1, x - 1] + 2 * g[y - 1, x] + g[y - 1, x + 1])
    return row, col

# %% name="absolute values" origin="walk" sentence="You take the absolute value, but a jump from bright to dark must be negative: leave np.abs out." must_say=["absolute|\\babs\\b|without (its|their) sign|sign is lost", "negative|sign|leave"] must_not_say=["turned around", "swap"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return np.abs(row), np.abs(col)

# %% name="image times kernel" origin="walk" sentence="gray * kernel multiplies arrays of different shapes: the 3 × 3 kernel must slide over the image, nine products for each pixel." must_say=["shape|broadcast|size", "slide|each pixel|every pixel|nine|neighbo|window"] kind="error"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    grad_col = gray * kernel
    grad_row = gray * kernel.T
    return grad_row.astype(np.int32), grad_col.astype(np.int32)

# %% name="results in the wrong order" origin="new" sentence="You return grad_col first, and the task wants grad_row, grad_col: exchange the two." must_say=["grad_row", "grad_col", "first|order|swap|exchang|wrong way"] must_not_say=["border", "dtype"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return col, row

# %% name="sign turned around" origin="new" sentence="Both signs are turned around: take right minus left, and below minus above." must_say=["sign|minus", "both|right minus left|turned|wrong", "right|both|grad_col|below"] must_not_say=["border", "dtype"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2]) - (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:])
    row = (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:]) - (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:])
    return row, col

# %% name="sign of the rows turned around" origin="new" sentence="grad_row has the wrong sign: it is the row below minus the row above." must_say=["grad_row", "sign|below minus above|minus"] must_not_say=["border", "dtype"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:]) - (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:])
    return row, col

# %% name="subtracted in uint8" origin="new" sentence="The differences are computed in uint8 and wrap around below 0: widen with astype(np.int32) before you subtract." must_say=["uint8", "wrap|below 0|before you subtract|negative", "widen|astype|int32"] kind="value"
def my_sobel(gray):
    p = np.pad(gray, 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return row.astype(np.int32), col.astype(np.int32)

# %% name="weights 1, 1, 1" origin="new" sentence="These are equal weights (Prewitt's); Sobel gives the middle row double weight: 1, 2, 1." must_say=["double|twice|equal weights|same weight|prewitt|1, 1, 1|1, 2, 1", "weight|middle"] must_not_say=["border", "sign", "order"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + p[:-2, 1:-1] + p[:-2, 2:])
    return row, col

# %% name="simple differences of one row" origin="new" sentence="You take the difference of one row only; Sobel adds three rows with the weights 1, 2, 1." must_say=["one row|three rows|single row|neighbours only|1, 2, 1", "three|1, 2, 1|weight"] must_not_say=["sign", "swap"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    return p[2:, 1:-1] - p[:-2, 1:-1], p[1:-1, 2:] - p[1:-1, :-2]

# %% name="zero padding" origin="new" sentence="np.pad without a mode puts zeros around the image and makes false edges at its border: use mode=\"edge\"." must_say=["zeros|without a mode|constant|padd?(ed|ing)? with 0|zero padding", "mode|edge\"|repeat|replicat"] must_not_say=["swap"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1)
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return row, col

# %% name="reflect padding" origin="new" sentence="mode=\"reflect\" mirrors the image at the border, as OpenCV's plain Sobel does; this task repeats the outermost row and column: use mode=\"edge\"." must_say=["reflect|mirror", "edge|repeat|replicat"] must_not_say=["swap"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="reflect")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return row, col

# %% name="result of uint8" origin="new" sentence="Filter responses run from -1020 to 1020 and do not fit into uint8: make the results int32." must_say=["uint8", "int32", "fit|negative|-1020|results?|1020|cut"] kind="dtype"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return row.astype(np.uint8), col.astype(np.uint8)

# %% name="divided by 4" origin="new" sentence="You divide the filter response by 4; the task asks for the plain Sobel response, where a step of 150 gives 600." must_say=["divid|\\b4\\b|scal", "sobel|plain|600|response|leave|without"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return row // 4, col // 4

# %% name="magnitude instead of the pair" origin="new" sentence="You return one array, the magnitude; the task asks for two arrays, grad_row and grad_col." must_say=["magnitude|one array|single array", "two|both|pair|tuple"] kind="type"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return np.abs(row) + np.abs(col)

# %% name="smaller by the border" origin="new" sentence="Your arrays have two rows and two columns less than the image: repeat the border with np.pad before you take the slices." must_say=["smaller|less than|fewer|too small|shape", "pad|border|repeat"] kind="shape"
def my_sobel(gray):
    p = gray.astype(np.int32)
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return row, col

# %% name="same kernel for both" origin="new" sentence="You use the same kernel for both results: grad_row needs the transposed weights, kernel.T." must_say=["same kernel|same weights|kernel|both", "transpos|\\.T\\b"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    h, w = gray.shape
    grad_col = np.zeros((h, w), np.int32)
    grad_row = np.zeros((h, w), np.int32)
    for y in range(3):
        for x in range(3):
            grad_col += kernel[y, x].astype(np.int32) * p[y : y + h, x : x + w]
            grad_row += kernel[y, x].astype(np.int32) * p[y : y + h, x : x + w]
    return grad_row, grad_col

# %% name="true convolution turns the kernel" origin="new" sentence="A convolution turns the kernel around, so both signs come out wrong: use the kernel as it stands (a correlation), right minus left and below minus above." must_say=["convol|flip|kernel", "sign|correl|as it stands|right minus left|minus|turn"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]], dtype=np.int32)
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    h, w = gray.shape

    def convolve(k):
        k = k[::-1, ::-1]
        out = np.zeros((h, w), np.int32)
        for y in range(3):
            for x in range(3):
                out += k[y, x] * p[y : y + h, x : x + w]
        return out

    return convolve(kernel.T), convolve(kernel)

# %% name="np.roll wraps around" origin="new" sentence="np.roll brings the opposite side of the image in at the border: repeat the outermost rows and columns with np.pad instead." must_say=["roll|opposite|other side|wrap", "pad|repeat|replicat|border"] kind="value"
def my_sobel(gray):
    g = gray.astype(np.int32)
    smooth_rows = np.roll(g, 1, 0) + 2 * g + np.roll(g, -1, 0)
    smooth_cols = np.roll(g, 1, 1) + 2 * g + np.roll(g, -1, 1)
    return np.roll(smooth_cols, -1, 0) - np.roll(smooth_cols, 1, 0), np.roll(smooth_rows, -1, 1) - np.roll(smooth_rows, 1, 1)

# %% name="cv2.Sobel" origin="new" sentence="cv2 is refused in this task: build the response from shifted slices or loops with NumPy." must_say=["cv2|opencv", "refus|not allowed|numpy|yourself|by hand|forbid"] kind="refused"
import cv2


def my_sobel(gray):
    grad_row = cv2.Sobel(gray, cv2.CV_16S, 0, 1, borderType=cv2.BORDER_REPLICATE)
    grad_col = cv2.Sobel(gray, cv2.CV_16S, 1, 0, borderType=cv2.BORDER_REPLICATE)
    return grad_row.astype(np.int32), grad_col.astype(np.int32)

# %% name="the course's sobel" origin="new" sentence="sobel is the course's own function, from another cell: the task is to write it yourself." must_say=["\\bsobel\\b", "yourself|own|another cell|refus|import"] kind="other-cell"
def my_sobel(gray):
    grad_row, grad_col = sobel(gray)
    return grad_row, grad_col

# %% name="scipy correlates" origin="new" sentence="scipy is refused in this task: slide the kernel over the image with NumPy." must_say=["scipy|ndimage", "refus|not allowed|numpy|yourself|by hand|forbid"] kind="refused"
from scipy import ndimage


def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    g = gray.astype(np.int32)
    return ndimage.correlate(g, kernel.T, mode="nearest"), ndimage.correlate(g, kernel, mode="nearest")

# %% name="one array of both" origin="new" sentence="np.stack makes one array of three dimensions; return the two arrays with a comma between them." must_say=["stack|one array|three dimensions|single array", "two arrays|tuple|comma|both"] kind="type"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return np.stack([row, col])

# %% name="return forgotten" origin="new" sentence="The two arrays are computed, but the function has no return: add return grad_row, grad_col." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    grad_row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])

# %% name="only one loop" origin="walk" sentence="gray.shape holds two numbers, and a loop over it gives one number after the other: write two loops, for row in range(height): and in it for col in range(width):." must_say=["two loops|range\\("] must_not_say=["pad"] kind="error"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row, col in gray.shape:
        window = padded[row:row + 3, col:col + 3]
        grad_col[row, col] = (window * kernel).sum()
        grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="loops over the padded image" origin="walk" sentence="The loops go over the padded image, so the last windows are too small: loop over the rows and columns of gray." must_say=["loop over|rows and columns of (the image|gray)", "padded"] must_not_say=["how wide the padding"] kind="error"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    height, width = padded.shape
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(height):
        for col in range(width):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="window without the end of the slice" origin="walk" sentence="Your window has 2 × 2 pixels, because a slice ends before its stop: write row : row + 3 and col : col + 3." must_say=["row \\+ 3", "window"] must_not_say=["how wide the padding"] kind="error"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 2, col:col + 2]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="products not summed" origin="walk" sentence="window * kernel has nine values, and one element of grad_col holds one: add them, (window * kernel).sum()." must_say=["sum"] kind="error"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = window * kernel
            grad_row[row, col] = window * kernel.T
    return grad_row, grad_col

# %% name="the same array twice" origin="walk" sentence="grad_row = grad_col = np.zeros(...) gives one array two names, so the second result overwrites the first: make two arrays." must_say=["one array|two arrays"] must_not_say=["^(?!.*(one|two) array).*computed with the same transposed"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="np.dot of window and kernel" origin="walk" sentence="np.dot multiplies matrices; multiply value by value with *." must_say=["dot|matri", "\\*"] must_not_say=["swap"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, np.int32)
    grad_col = np.zeros(gray.shape, np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = np.dot(window, kernel).sum()
            grad_row[row, col] = np.dot(window, kernel.T).sum()
    return grad_row, grad_col

# %% name="padded by 2" origin="walk" sentence="Pad by 1: with 2 everything moves down and right." must_say=["pad", "\\b2\\b", "by 1|, 1,"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 2, mode="edge")
    grad_row = np.zeros(gray.shape, np.int32)
    grad_col = np.zeros(gray.shape, np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="width and height exchanged" origin="walk" sentence="A shape begins with the height: height, width = gray.shape." must_say=["height", "shape"] kind="error"
def my_sobel(gray):
    width, height = gray.shape
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros((height, width), np.int32)
    grad_col = np.zeros((height, width), np.int32)
    for row in range(height):
        for col in range(width):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="windows moved by one" origin="new" sentence="The windows begin one row and one column too early: the window of pixel (row, col) is padded[row : row + 3, col : col + 3]." must_say=["window", "one row|too early|row : row \\+ 3"] kind="value" must_not_say=["zeros", "not padded"]
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray, 1, mode="edge").astype(np.int32)
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(1, gray.shape[0]):
        for col in range(1, gray.shape[1]):
            window = padded[row - 1 : row + 2, col - 1 : col + 2]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="windows moved by one, the border left out" origin="new" sentence="The windows begin one row and one column too early: the window of pixel (row, col) is padded[row : row + 3, col : col + 3], for every pixel." must_say=["window", "one row|too early|row : row \\+ 3", "every"] kind="value" must_not_say=["zeros", "not padded"]
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray, 1, mode="edge").astype(np.int32)
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(1, gray.shape[0] - 1):
        for col in range(1, gray.shape[1] - 1):
            window = padded[row - 1 : row + 2, col - 1 : col + 2]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col
