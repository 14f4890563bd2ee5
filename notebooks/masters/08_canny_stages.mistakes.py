# %% [markdown]
# # canny-sobel

# %%
def gradients(gray, mode="edge", weights=(1, 2, 1)):
    p = np.pad(gray, 1, mode=mode)
    first, middle, last = weights
    along = first * p[:-2] + middle * p[1:-1] + last * p[2:]
    across = first * p[:, :-2] + middle * p[:, 1:-1] + last * p[:, 2:]
    return across[2:] - across[:-2], along[:, 2:] - along[:, :-2]

# %% role="mistake" name="uint8 wraps" says="This is uint8 wrap-around: dark minus bright went below 0 and continued at 255. Widen to int32 before you subtract."
def my_sobel(gray):
    grad_row, grad_col = gradients(gray)
    return grad_row.astype(np.int32), grad_col.astype(np.int32)

# %% role="mistake" name="uint8 results" says="Your results are uint8, but a response can be negative or larger than 255. Widen the image to int32 before you subtract, and return int32."
def my_sobel(gray):
    return gradients(gray)

# %% role="mistake" name="a convolution instead of a correlation" says="All signs are flipped, as in a convolution. Compute right minus left, and below minus above."
def my_sobel(gray):
    grad_row, grad_col = solution(gray)
    return -grad_row, -grad_col

# %% role="mistake" name="the sign of grad_col" says="grad_col has the wrong sign: it is the right column minus the left column."
def my_sobel(gray):
    grad_row, grad_col = solution(gray)
    return grad_row, -grad_col

# %% role="mistake" name="negative responses set to 0" says="Your negative responses became 0. From bright to dark a response is negative: keep it as it is."
def my_sobel(gray):
    grad_row, grad_col = solution(gray)
    return np.maximum(grad_row, 0), np.maximum(grad_col, 0)

# %% role="mistake" name="clipped to 0..255" says="Your responses were cut to the range 0 to 255. A response can be negative or larger than 255: keep it as it is."
def my_sobel(gray):
    grad_row, grad_col = solution(gray)
    return np.clip(grad_row, 0, 255), np.clip(grad_col, 0, 255)

# %% role="mistake" name="the same kernel for both" says="Both results are grad_col: both are computed with the same kernel, or both names stand for one array. grad_row needs the transposed kernel, kernel.T, and an array of its own."
def my_sobel(gray):
    _, grad_col = solution(gray)
    return grad_col, grad_col

# %% role="mistake" name="the transposed kernel for both" says="Both results are grad_row: both are computed with the same transposed kernel, or both names stand for one array. grad_col needs the kernel as it is, not transposed, and an array of its own."
def my_sobel(gray):
    grad_row, _ = solution(gray)
    return grad_row, grad_row

# %% role="mistake" name="zero padding at the border" says="The image was padded with zeros, so its border became an edge. Repeat the outermost rows and columns: np.pad(..., mode='edge')."
def my_sobel(gray):
    return gradients(gray.astype(np.int32), "constant")

# %% role="mistake" name="reflect padding at the border" says="The image was mirrored at its border (mode='reflect'). This task repeats the outermost rows and columns: np.pad(..., mode='edge')."
def my_sobel(gray):
    return gradients(gray.astype(np.int32), "reflect")

# %% role="mistake" name="np.roll at the border" says="At the border your function used pixels of the opposite side, as np.roll does. Repeat the outermost rows and columns instead: np.pad(..., mode='edge')."
def my_sobel(gray):
    return gradients(gray.astype(np.int32), "wrap")

# %% role="mistake" name="the Prewitt kernel" says="All three rows have the same weight: this is the Prewitt kernel. The Sobel kernel gives the middle row double weight."
def my_sobel(gray):
    return gradients(gray.astype(np.int32), weights=(1, 1, 1))

# %% role="mistake" name="one row only" says="Each difference uses one row only. Sobel adds three rows with the weights 1, 2, 1."
def my_sobel(gray):
    return gradients(gray.astype(np.int32), weights=(0, 1, 0))

# %% role="mistake" name="divided by 4" says="Your responses are divided by 4. Return the plain Sobel response: a step of 150 gives 600."
def my_sobel(gray):
    grad_row, grad_col = solution(gray)
    return grad_row // 4, grad_col // 4

# %% role="mistake" name="divided by 8" says="Your responses are divided by 8. Return the plain Sobel response: a step of 150 gives 600."
def my_sobel(gray):
    grad_row, grad_col = solution(gray)
    return grad_row // 8, grad_col // 8

# %% role="mistake" name="np.gradient" says="These are the values of np.gradient: half the difference of two neighbours in one row. Sobel adds three rows with the weights 1, 2, 1, and does not halve."
def my_sobel(gray):
    grad_row, grad_col = np.gradient(gray.astype(np.int32))
    return grad_row, grad_col

# %% role="mistake" name="the window begins at the pixel" says="Your results are one row and one column too far up and left, because the image was not padded. Pad it first: np.pad(..., 1, mode='edge')."
def my_sobel(gray):
    return tuple(np.pad(part[1:-1, 1:-1], ((0, 2), (0, 2))) for part in solution(gray))

# %% role="mistake" name="padded by 2" says="Your results are one row and one column too far down and right, because the image was padded by 2 pixels. Pad it by 1: np.pad(..., 1, mode='edge')."
def my_sobel(gray):
    height, width = gray.shape
    return tuple(part[:height, :width] for part in solution(np.pad(gray, 1, mode="edge")))

# %% role="mistake" name="the window before the pixel" says="Your results are one row and one column too far down and right, because the windows begin one row and one column too early. In the padded array, the window of pixel (row, col) is padded[row : row + 3, col : col + 3], for every row and column from 0."
def my_sobel(gray):
    return tuple(np.pad(part[:-1, :-1], ((1, 0), (1, 0))) for part in solution(gray))

# %% role="mistake" name="the window before the pixel, without the border" says="Your results are one row and one column too far down and right, because the windows begin one row and one column too early. In the padded array, the window of pixel (row, col) is padded[row : row + 3, col : col + 3], for every row and column from 0."
def my_sobel(gray):
    return tuple(np.pad(part[:-2, :-2], 1) for part in solution(gray))

# %% role="mistake" name="int8 wraps" says="Your values wrapped around, as in int8, which ends at 127. Widen to int32 before you subtract."
def my_sobel(gray):
    grad_row, grad_col = gradients(gray.astype(np.int8))
    return grad_row.astype(np.int32), grad_col.astype(np.int32)

# %% role="mistake" name="the mean of the products" says="Your responses are nine times too small, as if the mean of the nine products was taken. Take their sum."
def my_sobel(gray):
    return tuple(np.trunc(part / 9).astype(np.int32) for part in solution(gray))

# %% [markdown]
# # canny-suppression

# %%
def neighbours(magnitude, sector, mode="constant"):
    """The magnitudes of the first and the second neighbour of each pixel."""
    p = np.pad(magnitude, 1, mode=mode)
    row, col = np.indices(magnitude.shape) + 1
    d_row, d_col = np.array([[0, -1, -1, -1], [-1, -1, 0, 1]])[:, sector]
    return p[row + d_row, col + d_col], p[row - d_row, col - d_col]

def is_kept(value, first, second, sector):
    return (value > first) & ((value > second) | ((value == second) & (sector % 2 == 0)))

def thin(magnitude, keep):
    return np.where(keep, magnitude, 0).astype(np.int32)

# %% role="mistake" name="> and >= swapped" says="The two comparisons are swapped: a pixel must be greater than the first neighbour (left or above), and greater than or equal to the second."
def suppress(magnitude, sector):
    first, second = neighbours(magnitude, sector)
    return thin(magnitude, is_kept(magnitude, second, first, sector))

# %% role="mistake" name="> and >= swapped, in every sector" says="The two comparisons are swapped: use > for the first neighbour. For the second, use >= in sectors 0 and 2, and > in sectors 1 and 3."
def suppress(magnitude, sector):
    first, second = neighbours(magnitude, sector)
    return thin(magnitude, (magnitude >= first) & (magnitude > second))

# %% role="mistake" name="along the edge instead of across it" says="Each pixel was compared with neighbours along the edge instead of across it. In sector 0 the gradient points along the row, so the neighbours are left and right."
def suppress(magnitude, sector):
    return solution(magnitude, ((sector + 2) % 4).astype(np.uint8))

# %% role="mistake" name="sectors 0 and 2 swapped" says="Sectors 0 and 2 are swapped: sector 0 compares with left and right, sector 2 with above and below."
def suppress(magnitude, sector):
    return solution(magnitude, np.where(sector % 2 == 0, 2 - sector, sector).astype(np.uint8))

# %% role="mistake" name="the diagonals swapped" says="Sectors 1 and 3 are swapped: sector 1 compares with above left and below right, sector 3 with above right and below left."
def suppress(magnitude, sector):
    return solution(magnitude, np.where(sector % 2 == 1, 4 - sector, sector).astype(np.uint8))

# %% role="mistake" name="the padded array without + 1" says="Your function reads the padded array at [row, col], one row and one column too far up and left. After np.pad(magnitude, 1), pixel (row, col) is at padded[row + 1, col + 1], its left neighbour at padded[row + 1, col]."
def suppress(magnitude, sector):
    thinned, padded = np.zeros_like(magnitude), np.pad(magnitude, 1)
    for row, col in np.ndindex(magnitude.shape):
        d_row, d_col = ((0, -1), (-1, -1), (-1, 0), (-1, 1))[sector[row, col]]
        value, first = padded[row, col], padded[row + d_row, col + d_col]
        if is_kept(value, first, padded[row - d_row, col - d_col], sector[row, col]):
            thinned[row, col] = value
    return thinned

# %% role="mistake" name="all eight neighbours" says="Each pixel was compared with all eight neighbours. Compare it only with the two neighbours along its gradient; otherwise an edge breaks where its magnitude changes."
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    height, width = magnitude.shape
    around = [p[r : r + height, c : c + width] for r in range(3) for c in range(3) if (r, c) != (1, 1)]
    return thin(magnitude, magnitude > np.max(around, axis=0))

# %% role="mistake" name="above and below in every sector" says="Every pixel was compared with above and below. Which two neighbours to compare with depends on the sector of the pixel."
def suppress(magnitude, sector):
    return solution(magnitude, np.full_like(sector, 2))

# %% role="mistake" name="sector 1 missing" says="The pixels of sector 1 are always 0, as if sector 1 is missing. Compare them with above left and below right."
def suppress(magnitude, sector):
    return np.where(sector == 1, 0, solution(magnitude, sector))

# %% role="mistake" name="sector 2 missing" says="The pixels of sector 2 are always 0, as if sector 2 is missing. Compare them with above and below."
def suppress(magnitude, sector):
    return np.where(sector == 2, 0, solution(magnitude, sector))

# %% role="mistake" name="sector 3 missing" says="The pixels of sector 3 are always 0, as if sector 3 is missing. Compare them with above right and below left."
def suppress(magnitude, sector):
    return np.where(sector == 3, 0, solution(magnitude, sector))

# %% role="mistake" name="sector 0 alone" says="Only the pixels of sector 0 were kept. Sectors 1, 2 and 3 need their comparisons, too."
def suppress(magnitude, sector):
    return np.where(sector == 0, solution(magnitude, sector), 0)

# %% role="mistake" name="sectors 1 to 4" says="Your sectors are numbered from 1 to 4, but the table numbers them from 0 to 3: sector 0 compares with left and right."
def suppress(magnitude, sector):
    return np.where(sector == 0, 0, solution(magnitude, np.maximum(sector, 1) - 1))

# %% role="mistake" name="the sector one pixel off" says="The sector is read one row and one column too far up and left, as from a padded array. It is not padded: the sector of pixel (row, col) is sector[row, col]."
def suppress(magnitude, sector):
    return solution(magnitude, np.pad(sector, 1)[:-2, :-2])

# %% role="mistake" name="keep not set to False" says="A pixel was kept because an earlier pixel was: keep stays True until it is set again. Write keep = False at the beginning of each pixel."
def suppress(magnitude, sector):
    keep, thinned = False, np.zeros_like(magnitude)
    is_maximum = solution(magnitude, sector) > 0
    for row, col in np.ndindex(magnitude.shape):
        keep = keep or is_maximum[row, col]
        thinned[row, col] = magnitude[row, col] if keep else 0
    return thinned

# %% role="mistake" name="or for and" says="One smaller neighbour was enough to keep a pixel, as with or. Both comparisons must be true: use and."
def suppress(magnitude, sector):
    first, second = neighbours(magnitude, sector)
    second_is_smaller = (magnitude > second) | ((magnitude == second) & (sector % 2 == 0))
    return thin(magnitude, (magnitude > first) | second_is_smaller)

# %% role="mistake" name="the first neighbour alone" says="Each pixel was compared with its first neighbour only. It must also be compared with the second one."
def suppress(magnitude, sector):
    first, _ = neighbours(magnitude, sector)
    return thin(magnitude, magnitude > first)

# %% role="mistake" name="minima instead of maxima" says="The pixels with the smallest magnitude were kept. Turn the comparisons around: a pixel is kept if it is greater than its neighbours."
def suppress(magnitude, sector):
    first, second = neighbours(magnitude, sector)
    return thin(magnitude, (magnitude < first) & (magnitude <= second))

# %% role="mistake" name="nothing suppressed" says="Every pixel keeps its magnitude: nothing was suppressed. A pixel that is not a maximum must become 0."
def suppress(magnitude, sector):
    return magnitude.copy()

# %% role="mistake" name="the border repeated" says="The magnitude was repeated at the border (mode='edge'). Outside the image it must be 0: pad with np.pad(magnitude, 1)."
def suppress(magnitude, sector):
    return thin(magnitude, is_kept(magnitude, *neighbours(magnitude, sector, "edge"), sector))

# %% role="mistake" name="np.roll at the border" says="At the border a pixel was compared with pixels of the opposite side, as np.roll does. Outside the image the magnitude is 0: pad with np.pad(magnitude, 1)."
def suppress(magnitude, sector):
    return thin(magnitude, is_kept(magnitude, *neighbours(magnitude, sector, "wrap"), sector))

# %% role="mistake" name="the shift of the padding" says="The neighbours are one row and one column off. After np.pad(magnitude, 1), pixel (row, col) is at padded[row + 1, col + 1]."
def suppress(magnitude, sector):
    first, second = neighbours(np.pad(magnitude, 1), np.pad(sector, ((0, 2), (0, 2)), mode="edge"))
    inside = np.s_[: magnitude.shape[0], : magnitude.shape[1]]
    return thin(magnitude, is_kept(magnitude, first[inside], second[inside], sector))

# %% role="mistake" name="a square image" says="A part of your result is 0, as if the loops treat the image as a square. The rows end at magnitude.shape[0], the columns at magnitude.shape[1]."
def suppress(magnitude, sector):
    size = min(magnitude.shape)
    thinned = np.zeros_like(magnitude)
    thinned[:size, :size] = solution(magnitude, sector)[:size, :size]
    return thinned

# %% role="mistake" name="the number of rows for the columns" says="The loop over the columns ends at the number of rows. The rows end at magnitude.shape[0], the columns at magnitude.shape[1]."
def suppress(magnitude, sector):
    thinned = np.zeros_like(magnitude)
    for row in range(magnitude.shape[0]):
        for col in range(magnitude.shape[0]):
            thinned[row, col] = solution(magnitude, sector)[row, col]
    return thinned

# %% role="mistake" name="compared in uint8" says="The magnitudes were compared as uint8, where values above 255 wrap around. Compare them as int32."
def suppress(magnitude, sector):
    first, second = neighbours(magnitude.astype(np.uint8), sector)
    return thin(magnitude, is_kept(magnitude.astype(np.uint8), first, second, sector))

# %% role="mistake" name="255 for a kept pixel" says="A kept pixel became 255. It keeps its magnitude."
def suppress(magnitude, sector):
    return np.where(solution(magnitude, sector) > 0, 255, 0).astype(np.int32)

# %% role="mistake" name="1 for a kept pixel" says="A kept pixel became 1. It keeps its magnitude."
def suppress(magnitude, sector):
    return np.where(solution(magnitude, sector) > 0, 1, 0).astype(np.int32)

# %% role="mistake" name="uint8, values above 255 cut" says="Your result is uint8, but a magnitude can be larger than 255. Make the result int32."
def suppress(magnitude, sector):
    return np.minimum(solution(magnitude, sector), 255).astype(np.uint8)

# %% role="mistake" name="equal neighbours kept on the diagonals" says="In sectors 1 and 3 (the diagonals) equal neighbours were kept. There a pixel must be greater than both neighbours: use >."
def suppress(magnitude, sector):
    first, second = neighbours(magnitude, sector)
    is_diagonal = (sector % 2 == 1) & (magnitude >= first) & (magnitude >= second)
    return thin(magnitude, is_kept(magnitude, first, second, sector) | is_diagonal)

# %% role="mistake" name="compared with pixels that are 0 already" says="A pixel was compared with a neighbour that your function had already set to 0. Compare with the unchanged magnitude, and write into a new array."
def suppress(magnitude, sector):
    thinned = magnitude.copy()
    for row, col in np.ndindex(magnitude.shape):
        first, second = (part[row, col] for part in neighbours(thinned, sector))
        if not is_kept(magnitude[row, col], first, second, sector[row, col]):
            thinned[row, col] = 0
    return thinned

# %% [markdown]
# # canny-thresholds

# %% role="mistake" name=">= for low, and a value equal to high is neither" says="A value equal to low is not above it, so it is not weak. A value equal to high is not above it, so it is weak."
def double_threshold(thinned, low, high):
    return (thinned >= low) & (thinned < high), thinned > high

# %% role="mistake" name="below low" says="Your weak pixels are those below low. Turn the comparison around: a weak pixel is above low, but not above high."
def double_threshold(thinned, low, high):
    return thinned < low, thinned > high

# %% role="mistake" name="all that is not strong" says="Every pixel that is not strong became weak. A weak pixel must also be above low: combine both conditions with &."
def double_threshold(thinned, low, high):
    return thinned <= high, thinned > high

# %% role="mistake" name="| for &" says="Every pixel is weak in your masks, as with | (or). A weak pixel is above low and not above high: combine both conditions with &."
def double_threshold(thinned, low, high):
    return np.ones(thinned.shape, dtype=bool), thinned > high

# %% role="mistake" name="low and high swapped" says="Every pixel above low is strong in your masks, and no pixel is weak, as if low and high are swapped. Strong means above high; weak means above low, but not above high."
def double_threshold(thinned, low, high):
    return np.zeros(thinned.shape, dtype=bool), thinned > low

# %% role="mistake" name="50 and 150" says="Your function always compares with 50 and 150. Use the arguments low and high: another call has other thresholds."
def double_threshold(thinned, low, high):
    return (thinned > 50) & (thinned <= 150), thinned > 150

# %% role="mistake" name="divided by 4" says="The thresholds were divided by 4. low and high have the same unit as thinned already: compare with them as they are."
def double_threshold(thinned, low, high):
    return (thinned > low / 4) & (thinned <= high / 4), thinned > high / 4

# %% role="mistake" name="multiplied by 4" says="The thresholds were multiplied by 4. low and high have the same unit as thinned already: compare with them as they are."
def double_threshold(thinned, low, high):
    return (thinned > 4 * low) & (thinned <= 4 * high), thinned > 4 * high

# %% role="mistake" name="the values picked out" says="You returned the values of the pixels, and their places are lost. Return the masks themselves: bool arrays with the shape of thinned."
def double_threshold(thinned, low, high):
    return tuple(thinned[mask] for mask in solution(thinned, low, high))

# %% role="mistake" name="positions" says="You returned the positions of the pixels. Return masks, bool arrays with the shape of thinned: a comparison such as thinned > high is one."
def double_threshold(thinned, low, high):
    return tuple(np.argwhere(mask) for mask in solution(thinned, low, high))

# %% [markdown]
# # canny-hysteresis

# %%
EIGHT = [(row, col) for row in (-1, 0, 1) for col in (-1, 0, 1)]

def touching(edges, directions=EIGHT):
    """True at each pixel that has an edge pixel in one of these directions."""
    height, width = edges.shape
    p = np.pad(edges, 1)
    return np.any([p[1 + r : 1 + r + height, 1 + c : 1 + c + width] for r, c in directions], axis=0)

def after_steps(weak, strong, steps=10_000, directions=EIGHT):
    edges = strong.copy()
    for _ in range(steps):
        larger = edges | (weak & touching(edges, directions))
        if larger.sum() == edges.sum():
            break
        edges = larger
    return as_image(edges)

def after_sweep(weak, strong, pixels):
    """The edges after one sweep over the pixels, each new edge used at once."""
    edges = strong.copy()
    for row, col in pixels:
        if weak[row, col] and edges[max(row - 1, 0) : row + 2, max(col - 1, 0) : col + 2].any():
            edges[row, col] = True
    return as_image(edges)

def as_image(edges):
    return np.where(edges, 255, 0).astype(np.uint8)

# %% role="mistake" name="four neighbours only" says="Your function uses only the four neighbours at the sides, not the corners, so slanted lines break. Use 8-connectivity: each pixel has eight neighbours."
def grow(weak, strong):
    return after_steps(weak, strong, directions=[(-1, 0), (1, 0), (0, -1), (0, 1)])

# %% role="mistake" name="the four corners only" says="Your function uses only the four neighbours at the corners, not those at the sides. Each pixel has eight neighbours."
def grow(weak, strong):
    return after_steps(weak, strong, directions=[(-1, -1), (-1, 1), (1, -1), (1, 1)])

# %% role="mistake" name="above and left only" says="Your edges grow only downwards and to the right, as if the window ends too early. It has three rows and three columns: row - 1 : row + 2 and col - 1 : col + 2."
def grow(weak, strong):
    return after_steps(weak, strong, directions=[(-1, -1), (-1, 0), (0, -1)])

# %% role="mistake" name="one sweep" says="One sweep over the image is not enough: it does not follow a chain that runs up or to the left. Repeat the sweep until nothing changes."
def grow(weak, strong):
    return after_sweep(weak, strong, np.ndindex(weak.shape))

# %% role="mistake" name="one sweep down the columns" says="One sweep over the image is not enough: it does not follow a chain that runs up or to the left. Repeat it until nothing changes."
def grow(weak, strong):
    return after_sweep(weak, strong, [(row, col) for col, row in np.ndindex(weak.T.shape)])

# %% role="mistake" name="two sweeps" says="Two sweeps, forwards and backwards, are not enough for a chain with many turns. Repeat them until nothing changes."
def grow(weak, strong):
    pixels = list(np.ndindex(weak.shape))
    return after_sweep(weak, strong, pixels + pixels[::-1])

# %% role="mistake" name="np.roll across the border" says="Edges jumped across the border of the image. np.roll moves the last row or column to the other end, so the left border touches the right one. Pad with False and take shifted arrays instead."
def grow(weak, strong):
    edges = strong
    while True:
        near = np.any([np.roll(edges, step, axis=(0, 1)) for step in EIGHT], axis=0)
        larger = edges | (weak & near)
        if larger.sum() == edges.sum():
            return as_image(edges)
        edges = larger

# %% role="mistake" name="the border left out" says="The weak pixels on the border of the image never became edges, as if they were left out. Pad with False, and visit every pixel."
def grow(weak, strong):
    inner = np.pad(np.ones_like(weak)[1:-1, 1:-1], 1)
    return after_steps(weak & inner, strong)

# %% role="mistake" name="one step only" says="The edges grew by one step and stopped. Repeat the step until nothing changes. If the loop compares edges with an old array, write old = edges.copy(): after old = edges both are the same array."
def grow(weak, strong):
    return after_steps(weak, strong, 1)

# %% role="mistake" name="the strong pixels alone" says="You returned only the strong pixels. Let them grow along the weak pixels that touch them."
def grow(weak, strong):
    return as_image(strong)

# %% role="mistake" name="weak and strong exchanged" says="The edges started from the weak pixels and grew into the strong ones. Start from strong, and grow into weak."
def grow(weak, strong):
    return after_steps(strong, weak)

# %% role="mistake" name="all weak pixels" says="All weak pixels became edges. Keep only those that a chain of weak pixels connects to a strong pixel."
def grow(weak, strong):
    return as_image(weak | strong)

# %% role="mistake" name="grows over everything" says="Your edges grew over pixels that are not weak. Grow only where weak is True: weak & ..."
def grow(weak, strong):
    return as_image(np.ones_like(weak))

# %% role="mistake" name="all pixels that touch an edge" says="Your edges also contain pixels that are not weak. A new edge pixel must be weak: weak & ..."
def grow(weak, strong):
    return as_image(strong | touching(solution(weak, strong) == 255))

# %% role="mistake" name="a negative slice at the border" says="Weak pixels in the first row and the first column were left out: there row - 1 or col - 1 is -1, and such a slice is empty. Pad with False first, or use max(row - 1, 0)."
def grow(weak, strong):
    reachable = weak.copy()
    reachable[0] = reachable[:, 0] = False
    return after_steps(reachable, strong)
