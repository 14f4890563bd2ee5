# %% name="border left at 0" origin="walk" sentence="Your border pixels stay 0, because the loop leaves them out: repeat the outermost rows and columns with np.pad(gray, 1, mode=\"edge\") first." must_say=["border|outermost|outer row", "stays? 0|left (at )?0|are 0|black|leaves? (it|them) out|leaves? out|inner|not visited", "pad|repeat|replicat"] must_not_say=["wrong pixel must be gone"] kind="value"
def median3(gray):
    result = np.zeros_like(gray)
    for y in range(1, gray.shape[0] - 1):
        for x in range(1, gray.shape[1] - 1):
            result[y, x] = np.sort(gray[y - 1 : y + 2, x - 1 : x + 2], axis=None)[4]
    return result

# %% name="border copied" origin="walk" sentence="You copy the border pixels unchanged, but they need a median too: repeat the outermost rows and columns (np.pad with mode=\"edge\") and visit every pixel." must_say=["border|outermost|outer row", "cop(y|ied|ies)|unchanged|need a median", "pad|repeat|replicat|every pixel"] must_not_say=["zero"] kind="value"
def median3(gray):
    result = gray.copy()
    for y in range(1, gray.shape[0] - 1):
        for x in range(1, gray.shape[1] - 1):
            result[y, x] = np.median(gray[y - 1 : y + 2, x - 1 : x + 2])
    return result

# %% name="window cut at the border" origin="walk" sentence="At the border your window has fewer than nine values: repeat the outermost rows and columns, so that every pixel has nine." must_say=["border|outermost|edge of the image", "fewer|less|nine|\\b9\\b|smaller|cut", "repeat|replicat|pad|nine|\\b9\\b"] kind="value"
def median3(gray):
    result = np.empty_like(gray)
    for y in range(gray.shape[0]):
        for x in range(gray.shape[1]):
            window = gray[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2]
            result[y, x] = np.sort(window, axis=None)[window.size // 2]
    return result

# %% name="not sorted" origin="walk" sentence="The fifth of nine values is the median only after sorting: sort the neighbours first." must_say=["\\bsort(ed|ing)?\\b", "not sorted|only after|first|fifth|before|middle|without sorting"] must_not_say=["border", "\\bmean\\b", "from 0"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.empty_like(gray)
    for y in range(gray.shape[0]):
        for x in range(gray.shape[1]):
            neighbours = padded[y : y + 3, x : x + 3].ravel()
            result[y, x] = neighbours[4]
    return result

# %% name="index -1 at the border" origin="walk" sentence="At the border gray[y - 1] becomes gray[-1], the last row on the other side of the image: repeat the outermost rows and columns with np.pad first." must_say=["-1|other side|last row|negative|outside|out of bounds", "pad|repeat|replicat|border"] kind="error"
def median3(gray):
    result = np.empty_like(gray)
    for y in range(gray.shape[0]):
        for x in range(gray.shape[1]):
            values = []
            for dy in (-1, 0, 1):
                for dx in (-1, 0, 1):
                    values.append(gray[y + dy, x + dx])
            result[y, x] = sorted(values)[4]
    return result

# %% name="in place on a copy" origin="walk" sentence="You read from the same array that you write to, so a pixel sees neighbours that are changed already: read from gray and write into a new array." must_say=["already|same array|in place", "new array|another array|separate|write into|result"] must_not_say=["border"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    for y in range(1, gray.shape[0] + 1):
        for x in range(1, gray.shape[1] + 1):
            padded[y, x] = np.median(padded[y - 1 : y + 2, x - 1 : x + 2])
    return padded[1:-1, 1:-1].copy()

# %% name="zero padding" origin="new" sentence="np.pad without a mode puts zeros around the image, and the border gets dark: repeat the outermost rows and columns with mode=\"edge\"." must_say=["zeros|without a mode|constant|padd?(ed|ing)? with 0|zero padding", "mode|edge|repeat|replicat"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1)
    h, w = gray.shape
    stack = [padded[y : y + h, x : x + w] for y in range(3) for x in range(3)]
    return np.sort(stack, axis=0)[4]

# %% name="reflect padding" origin="new" sentence="mode=\"reflect\" mirrors the second row instead of repeating the first: use mode=\"edge\"." must_say=["reflect|mirror", "edge|repeat|replicat|outermost"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="reflect")
    h, w = gray.shape
    stack = [padded[y : y + h, x : x + w] for y in range(3) for x in range(3)]
    return np.median(stack, axis=0).astype(np.uint8)

# %% name="np.roll wraps around" origin="new" sentence="np.roll brings in the pixels from the opposite side of the image at the border: repeat the outermost rows and columns with np.pad instead." must_say=["roll|opposite|other side", "pad|repeat|replicat|border"] kind="value"
def median3(gray):
    stack = []
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            stack.append(np.roll(gray, (dy, dx), axis=(0, 1)))
    return np.median(stack, axis=0).astype(np.uint8)

# %% name="mean instead of median" origin="new" sentence="You take the mean, which smears the wrong pixel over its neighbours: take the median, the fifth of the nine sorted values." must_say=["\\bmean\\b|average", "median|sort|middle|fifth"] must_not_say=["border"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    h, w = gray.shape
    stack = [padded[y : y + h, x : x + w] for y in range(3) for x in range(3)]
    return np.mean(stack, axis=0).astype(np.uint8)

# %% name="sum wraps in uint8" origin="new" sentence="This is a mean, and its sum runs past 255 in uint8; the task asks for the median: sort the nine values and take the middle one." must_say=["mean|average|sum", "median|sort|middle"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    h, w = gray.shape
    total = np.zeros_like(gray)
    for y in range(3):
        for x in range(3):
            total = total + padded[y : y + h, x : x + w]
    return total // 9

# %% name="fifth counted as index 5" origin="new" sentence="Python counts from 0, so the fifth of the nine sorted values has the index 4, not 5." must_say=["\\b4\\b", "index|from 0|from zero|fifth|middle|\\b5\\b"] must_not_say=["border"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    h, w = gray.shape
    stack = [padded[y : y + h, x : x + w] for y in range(3) for x in range(3)]
    return np.sort(stack, axis=0)[5]

# %% name="only the row is looked at" origin="new" sentence="You take the median of three values of one row; the neighbourhood is 3 × 3, so the rows above and below belong to it, too." must_say=["one row|three values|along the row|only .*row|left and right|horizontal", "nine|\\b9\\b|3 ?(×|x|by) ?3|above|below"] must_not_say=["axis 0"] kind="value"
def median3(gray):
    padded = np.pad(gray, ((0, 0), (1, 1)), mode="edge")
    return np.sort([padded[:, :-2], padded[:, 1:-1], padded[:, 2:]], axis=0)[1]

# %% name="rows first, then columns" origin="new" sentence="The median of the rows' medians is not the median of the nine values: sort all nine together." must_say=["medians|median of|two steps|separat|rows? first|one after the other", "nine|\\b9\\b|together"] must_not_say=["border"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    rows = np.sort([padded[:, :-2], padded[:, 1:-1], padded[:, 2:]], axis=0)[1]
    return np.sort([rows[:-2], rows[1:-1], rows[2:]], axis=0)[1]

# %% name="window of 2 x 2" origin="new" sentence="A slice ends before its last number, so y - 1 : y + 1 has two rows only: write y + 2 (and x + 2)." must_say=["slice|two rows|2 ?(×|x) ?2|four|stop|ends? before|too small", "\\+ ?2|3|three|nine"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.empty_like(gray)
    for y in range(1, gray.shape[0] + 1):
        for x in range(1, gray.shape[1] + 1):
            result[y - 1, x - 1] = np.median(padded[y - 1 : y + 1, x - 1 : x + 1])
    return result

# %% name="center left out" origin="new" sentence="You leave the pixel itself out and take the median of eight values: the neighbourhood has nine, the pixel in the middle is one of them." must_say=["itself|cent(er|re)|eight|\\b8\\b", "nine|\\b9\\b|include|belongs"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    h, w = gray.shape
    stack = [padded[y : y + h, x : x + w] for y in range(3) for x in range(3) if (y, x) != (1, 1)]
    return np.median(stack, axis=0).astype(np.uint8)

# %% name="smaller result" origin="new" sentence="Your result has two rows and two columns less than the image: pad the image by one pixel at each side before you cut out the slices." must_say=["result .*(less|smaller|fewer)|smaller|too small|two rows and two columns less|shape", "pad|border|repeat|replicat"] kind="shape"
def median3(gray):
    h, w = gray.shape
    stack = [gray[y : y + h - 2, x : x + w - 2] for y in range(3) for x in range(3)]
    return np.median(stack, axis=0).astype(np.uint8)

# %% name="padding not removed" origin="new" sentence="Your result is as large as the padded image, two rows and two columns too many: give back only the part without the padding." must_say=["too (many|large|big)|larger|as large as the padded|shape", "padding|padded|remove|cut|\\[1:-1"] kind="shape"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = padded.copy()
    for y in range(1, padded.shape[0] - 1):
        for x in range(1, padded.shape[1] - 1):
            result[y, x] = np.median(padded[y - 1 : y + 2, x - 1 : x + 2])
    return result

# %% name="median of the whole image" origin="new" sentence="You sort the whole image and get one number; each pixel needs the median of its own 3 × 3 neighbourhood." must_say=["whole image|one number|entire|all pixels", "own|each pixel|every pixel|neighbo"] kind="type"
def median3(gray):
    return np.sort(gray, axis=None)[gray.size // 2]

# %% name="median along one axis of the stack of rows" origin="new" sentence="axis=1 takes the median along the rows of the image: the nine shifted images lie along axis 0." must_say=["axis", "\\b0\\b|first|nine|stack"] kind="shape"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    h, w = gray.shape
    stack = np.array([padded[y : y + h, x : x + w] for y in range(3) for x in range(3)])
    return np.median(stack, axis=1).astype(np.uint8)

# %% name="input overwritten" origin="new" sentence="You write the medians into gray, so the input is changed and later pixels see changed neighbours: write into a new array." must_say=["input|\\bgray\\b|caller", "chang|overwrit|in place|write", "input .*chang|into gray|the input|caller"] kind="input-changed"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    for y in range(gray.shape[0]):
        for x in range(gray.shape[1]):
            gray[y, x] = np.median(padded[y : y + 3, x : x + 3])
    return gray

# %% name="only black and white pixels replaced" origin="new" sentence="You replace only the pixels 0 and 255; the task asks for the median at every pixel." must_say=["only|0 (and|or) 255|black|white", "every|each|all pixels"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    h, w = gray.shape
    stack = [padded[y : y + h, x : x + w] for y in range(3) for x in range(3)]
    median = np.median(stack, axis=0).astype(np.uint8)
    return np.where((gray == 0) | (gray == 255), median, gray)

# %% name="sort gives None" origin="new" sentence="list.sort() sorts in place and returns None: write values.sort() on its own line, or use sorted(values)." must_say=["None|in place", "sort"] kind="error"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.empty_like(gray)
    for y in range(gray.shape[0]):
        for x in range(gray.shape[1]):
            values = padded[y : y + 3, x : x + 3].ravel().tolist().sort()
            result[y, x] = values[4]
    return result

# %% name="the course's median_blur" origin="new" sentence="median_blur is the course's own function, from another cell; the task is to write the median yourself: sort the nine values." must_say=["median_blur", "yourself|by hand|own|another cell|other cell|refus|import|write"] kind="other-cell"
def median3(gray):
    return median_blur(gray, 3)

# %% name="return forgotten" origin="new" sentence="You fill result and never return it: add return result below the loops." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.empty_like(gray)
    for y in range(gray.shape[0]):
        for x in range(gray.shape[1]):
            result[y, x] = np.sort(padded[y : y + 3, x : x + 3], axis=None)[4]

# %% name="cv2 does it" origin="new" sentence="cv2 is refused here, since this task is the median by hand: sort the nine values with NumPy." must_say=["cv2|opencv", "by hand|refus|not allowed|numpy|yourself|forbid"] kind="refused"
import cv2


def median3(gray):
    return cv2.medianBlur(gray, 3)

# %% name="number of rows used for the columns" origin="new" sentence="Both loops end at gray.shape[0], the number of rows, but an image need not be square: the columns end at gray.shape[1]." must_say=["shape\\[1\\]|width|columns", "row|square|height|shape\\[0\\]"] must_not_say=["border"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    n = gray.shape[0]
    for y in range(n):
        for x in range(min(n, gray.shape[1])):
            result[y, x] = np.median(padded[y : y + 3, x : x + 3])
    return result
