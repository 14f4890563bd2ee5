# %% [markdown]
# # text-components

# %%
EIGHT = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]

def filled(mask, steps, starts=None, tested=True, first=0, columns=None):
    """The label image by flood fill over the given steps; first: the lowest row and column that is allowed."""
    labels, count, columns = np.zeros(mask.shape, int), 0, columns or mask.shape[1]
    for start in np.argwhere(mask).tolist() if starts is None else starts:
        stack = [tuple(start)] if labels[tuple(start)] == 0 else []
        count += len(stack)
        while stack:
            row, col = stack.pop()
            inside = first <= row < mask.shape[0] and first <= col < columns
            if (inside or not tested) and mask[row, col] and labels[row, col] == 0:
                labels[row, col] = count
                stack += [(row + i, col + j) for i, j in steps]
    return labels

def one_pass(mask, choose=min, before=((-1, -1), (-1, 0), (-1, 1), (0, -1))):
    """Each pixel takes a number of its neighbours before it; nothing is joined afterwards."""
    labels, count = np.zeros(mask.shape, int), 0
    for row, col in np.argwhere(mask).tolist():
        near = [labels[row + i, col + j] for i, j in before
                if row + i >= 0 and 0 <= col + j < mask.shape[1] and labels[row + i, col + j]]
        count += not near
        labels[row, col] = choose(near) if near else count
    return labels

# %% role="mistake" name="diagonals only" says="You visit only the neighbours at the corners. The four beside, above and below belong to a component too."
def label(mask):
    return filled(mask, [(i, j) for i, j in EIGHT if i and j])

# %% role="mistake" name="along the columns only" says="You visit only the neighbours above and below. A component also continues to the left, to the right and at the corners: eight neighbours."
def label(mask):
    return filled(mask, [(-1, 0), (1, 0)])

# %% role="mistake" name="forward only" says="You visit only neighbours to the right and below. A component can also go back to the left or up, like a U: visit all eight neighbours."
def label(mask):
    return filled(mask, [(0, 1), (1, 0), (1, 1)])

# %% role="mistake" name="one pass" says="Two parts that meet farther down keep different numbers, like the two sides of a U. With a stack: visit all eight neighbours. Row by row: the numbers of parts that meet must become one."
def label(mask):
    return one_pass(mask)

# %% role="mistake" name="one pass, the last neighbour" says="Two parts that meet farther down keep different numbers, like the two sides of a U. With a stack: visit all eight neighbours. Row by row: the numbers of parts that meet must become one."
def label(mask):
    return one_pass(mask, lambda near: near[-1])

# %% role="mistake" name="one pass, the first neighbour" says="Two parts that meet farther down keep different numbers, like the two sides of a U. With a stack: visit all eight neighbours. Row by row: the numbers of parts that meet must become one."
def label(mask):
    return one_pass(mask, lambda near: near[0])

# %% role="mistake" name="negative indices, upper limits tested" says="At the border, the index -1 is the other side of the image, so components wrap around. Test also that row and col are at least 0."
def label(mask):
    return filled(mask, EIGHT, first=-min(mask.shape))

# %% role="mistake" name="the number of rows for the columns" says="Columns on the right have no number: you compare col with the number of rows. mask.shape[0] is the number of rows, mask.shape[1] the number of columns."
def label(mask):
    return filled(mask, EIGHT, columns=min(mask.shape))

# %% role="mistake" name="column by column" says="Your numbers are in the order of the columns. Meet the components row by row, from left to right, as np.argwhere(mask) does."
def label(mask):
    return filled(mask, EIGHT, starts=np.argwhere(mask.T)[:, ::-1].tolist())

# %% role="mistake" name="from the last pixel" says="Your numbers begin at the end of the image. The first component that you meet from the upper left has the number 1."
def label(mask):
    return filled(mask, EIGHT, starts=np.argwhere(mask)[::-1].tolist())

# %% role="mistake" name="numbers from 0" says="Your numbers are one too low: the first component has the number 1, because 0 is the background."
def label(mask):
    return solution(mask) - 1

# %% role="mistake" name="numbers from 2" says="Your numbers are one too high where there is ink: the first component has the number 1."
def label(mask):
    return np.where(mask, solution(mask) + 1, 0)

# %% role="mistake" name="the background has 1" says="Your background has the number 1, and all others are one too high. The background is 0."
def label(mask):
    return solution(mask) + 1

# %% role="mistake" name="the mask" says="All ink has the number 1. Each component needs a number of its own: add 1 to the count for each new component."
def label(mask):
    return mask.astype(int)

# %% role="mistake" name="first component only" says="Only the first component has a number. Go on with the next pixel of ink that has none: does return or break end the loop too early?"
def label(mask):
    return np.where(solution(mask) == 1, 1, 0)

# %% role="mistake" name="the count as well" says="You return two things, the count and the label image. Return only the label image."
def label(mask):
    labels = solution(mask)
    return int(labels.max()), labels

# %% role="mistake" name="the label image and the count" says="You return two things, the label image and the count. Return only the label image."
def label(mask):
    labels = solution(mask)
    return labels, int(labels.max())

# %% role="mistake" name="sizes" says="You wrote the size of the component into its pixels. Write its number: 1, 2, 3 and so on."
def label(mask):
    labels = solution(mask)
    return np.where(mask, np.bincount(labels.ravel())[labels], 0)

# %% role="mistake" name="zeros" says="Your label image is full of zeros: no pixel ever got a number. Is the test for ink and for no number right, and does the first pixel come on the stack?"
def label(mask):
    return np.zeros(mask.shape, int)

# %% role="mistake" name="gaps in the numbers" says="Your numbers have gaps. Add 1 to the count only for a new component; or give the components the numbers 1, 2, 3 and so on at the end."
def label(mask):
    labels, ink = solution(mask), mask.cumsum()
    firsts = [0] + [int(ink[np.argmax(labels.ravel() == i)]) for i in range(1, labels.max() + 1)]
    return np.array(firsts)[labels]

# %% role="mistake" name="border left out" says="Pixels at the border of the image have no number. The test for inside must allow row 0, column 0, the last row and the last column."
def label(mask):
    inner = np.zeros_like(mask)
    inner[1:-1, 1:-1] = mask[1:-1, 1:-1]
    return filled(inner, EIGHT, np.argwhere(mask).tolist())

# %% role="mistake" name="the background too" says="Your background has a number, too. Begin with zeros, and go on only to pixels that are True in the mask."
def label(mask):
    return np.full(mask.shape, int(mask.any()))

# %% role="mistake" name="one pass, left first" says="Two parts that meet farther down keep different numbers, like the two sides of a U. With a stack: visit all eight neighbours. Row by row: the numbers of parts that meet must become one."
def label(mask):
    return one_pass(mask, lambda near: near[0], ((0, -1), (-1, -1), (-1, 0), (-1, 1)))

# %% [markdown]
# # text-ncc

# %%
def centered(a):
    return a - a.mean()

def quotient(products, squares, without_form=0.0):
    return float(products / np.sqrt(squares)) if squares > 0 else without_form

def norm2(a):
    return float((a * a).sum())

# %% role="mistake" name="only the first two rows" says="This compares the first two rows of a: np.corrcoef takes each row of a table for itself. Give it a.ravel() and b.ravel()."
def ncc(a, b):
    return float(np.corrcoef(a, b)[0, 1]) if np.ptp(a) and np.ptp(b) else 0.0

# %% role="mistake" name="means not subtracted, 0 / 0" says="Subtract from each image its own mean first; without this, two bright images always look alike. And test for an image without form: 0 / 0 is nan."
def ncc(a, b):
    return quotient((a * b).sum(), norm2(a) * norm2(b), float("nan"))

# %% role="mistake" name="means not subtracted, form tested" says="Subtract from each image its own mean first; without this, two bright images always look alike."
def ncc(a, b):
    return quotient((a * b).sum(), norm2(a) * norm2(b)) if np.ptp(a) and np.ptp(b) else 0.0

# %% role="mistake" name="means of the rows" says="You subtracted a mean of each row (axis=1). Subtract one mean, that of the whole image: a.mean()."
def ncc(a, b):
    a, b = a - a.mean(axis=1, keepdims=True), b - b.mean(axis=1, keepdims=True)
    return quotient((a * b).sum(), norm2(a) * norm2(b))

# %% role="mistake" name="means of the columns" says="You subtracted a mean of each column (axis=0). Subtract one mean, that of the whole image: a.mean()."
def ncc(a, b):
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    return quotient((a * b).sum(), norm2(a) * norm2(b))

# %% role="mistake" name="mean of b only" says="You subtracted the mean of b only. Subtract the mean of a from a as well."
def ncc(a, b):
    return quotient((a * centered(b)).sum(), norm2(a) * norm2(centered(b)))

# %% role="mistake" name="the mean of a from both" says="You subtracted the mean of a from both images. Each image has its own mean."
def ncc(a, b):
    return quotient((centered(a) * (b - a.mean())).sum(), norm2(centered(a)) * norm2(b - a.mean()))

# %% role="mistake" name="one mean of both" says="You subtracted one common mean from both images. Each image has its own mean."
def ncc(a, b):
    mean = (a.mean() + b.mean()) / 2
    return quotient(((a - mean) * (b - mean)).sum(), norm2(a - mean) * norm2(b - mean))

# %% role="mistake" name="without the root, 0 / 0" says="The square root is missing: divide by the root of both sums of squares. And test for an image without form: 0 / 0 is nan."
def ncc(a, b):
    squares = norm2(centered(a)) * norm2(centered(b))
    return float((centered(a) * centered(b)).sum() / squares) if squares else float("nan")

# %% role="mistake" name="roots added" says="You added the two roots. Multiply them: the root of both sums of squares, multiplied."
def ncc(a, b):
    roots = norm2(centered(a)) ** 0.5, norm2(centered(b)) ** 0.5
    return float((centered(a) * centered(b)).sum() / sum(roots)) if all(roots) else 0.0

# %% role="mistake" name="standardized, and summed" says="Your result is N times the NCC, N being the number of pixels. With standard deviations or means of squares below, take the mean of the products above, not the sum."
def ncc(a, b):
    return solution(a, b) * a.size

# %% role="mistake" name="standardized, and summed, 0 / 0" says="Your result is N times the NCC, N being the number of pixels. With standard deviations or means of squares below, take the mean of the products above, not the sum. And test for an image without form: 0 / 0 is nan."
def ncc(a, b):
    return solution(a, b) * a.size if np.ptp(a) and np.ptp(b) else float("nan")

# %% role="mistake" name="squares of b only" says="You divided by the sum of squares of b. The root contains both: the sum of squares of a, times the sum of squares of b."
def ncc(a, b):
    squares = norm2(centered(b))
    return float((centered(a) * centered(b)).sum() / squares) if squares else 0.0

# %% role="mistake" name="squares added" says="You added the two sums of squares. Multiply them before you take the root."
def ncc(a, b):
    return quotient((centered(a) * centered(b)).sum(), norm2(centered(a)) + norm2(centered(b)))

# %% role="mistake" name="squares not centered" says="The sums of squares contain the means again. Take the squares of a - a.mean() and b - b.mean()."
def ncc(a, b):
    return quotient((centered(a) * centered(b)).sum(), norm2(a) * norm2(b))

# %% role="mistake" name="never below 0" says="The NCC can be negative: do not make 0 of it, as max or clip does."
def ncc(a, b):
    return max(0.0, solution(a, b))

# %% role="mistake" name="squared" says="Your result is the square of the NCC. Take the root of the sums of squares, and square neither the quotient nor the sum of products."
def ncc(a, b):
    return solution(a, b) ** 2

# %% role="mistake" name="a distance" says="You return 1 minus the NCC. Return the NCC itself: 1 for images of the same form."
def ncc(a, b):
    return 1 - solution(a, b)

# %% role="mistake" name="flipped" says="You flipped one image, as a convolution does. A correlation multiplies the pixels at the same place."
def ncc(a, b):
    return solution(a, b[::-1, ::-1])

# %% role="mistake" name="rounded" says="The result is rounded. Return the exact number, and leave round out."
def ncc(a, b):
    return round(solution(a, b), 1)

# %% role="mistake" name="not summed" says="You return an array. Add the products with .sum(): the NCC is one number."
def ncc(a, b):
    root = np.sqrt(norm2(centered(a)) * norm2(centered(b)))
    return centered(a) * centered(b) / (root or 1.0)

# %% role="mistake" name="matrix product" says="@ and np.dot multiply matrices. Multiply pixel by pixel: (a_centered * b_centered).sum()."
def ncc(a, b):
    x, y = centered(a), centered(b)
    return quotient((x @ y.T).sum(), norm2(x) * norm2(y))
