# %% name="4 neighbours" origin="new" sentence="Pixels that touch at a corner belong together: visit eight neighbours, not four." must_say=["eight|8-conn|corner"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for r, c in np.argwhere(mask):
        if labels[r, c]:
            continue
        count += 1
        stack = [(r, c)]
        while stack:
            row, col = stack.pop()
            if row < 0 or col < 0 or row >= mask.shape[0] or col >= mask.shape[1]:
                continue
            if not mask[row, col] or labels[row, col]:
                continue
            labels[row, col] = count
            stack += [(row - 1, col), (row + 1, col), (row, col - 1), (row, col + 1)]
    return labels

# %% name="no test for negative" origin="new" sentence="Test that row and col are at least 0: -1 is the other side of the image." must_say=["-1|negative|at least 0|other side"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == 0:
            count += 1
            stack = [tuple(start)]
            while stack:
                row, col = stack.pop()
                row, col = row % mask.shape[0], col % mask.shape[1]
                if mask[row, col] and labels[row, col] == 0:
                    labels[row, col] = count
                    stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return labels

# %% name="no inside test at all" origin="new" sentence="A pixel at the border has neighbours outside of the image: test that row and col are inside." must_say=["inside|border|last index|bounds|outside|ends"] kind="error"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == 0:
            count += 1
            stack = [tuple(start)]
            while stack:
                row, col = stack.pop()
                if mask[row, col] and labels[row, col] == 0:
                    labels[row, col] = count
                    stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return labels

# %% name="count before the test" origin="new" sentence="Add 1 to the count only if the pixel has no number yet." must_say=["no number|count"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        count += 1
        stack = [tuple(start)]
        while stack:
            row, col = stack.pop()
            if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == 0:
                labels[row, col] = count
                stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return labels

# %% name="one pass from above and left" origin="new" sentence="Two parts that meet farther down must get one number." must_say=["meet|become one|join|one number"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for r in range(mask.shape[0]):
        for c in range(mask.shape[1]):
            if not mask[r, c]:
                continue
            near = []
            for i, j in ((-1, -1), (-1, 0), (-1, 1), (0, -1)):
                if r + i >= 0 and 0 <= c + j < mask.shape[1] and labels[r + i, c + j] > 0:
                    near.append(labels[r + i, c + j])
            if near:
                labels[r, c] = min(near)
            else:
                count += 1
                labels[r, c] = count
    return labels

# %% name="returns the count" origin="new" sentence="Return the label image, not how many components there are." must_say=["label image|labels|number of each pixel|shape|array"] kind="type"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == 0:
            count += 1
            stack = [tuple(start)]
            while stack:
                row, col = stack.pop()
                if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == 0:
                    labels[row, col] = count
                    stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return count

# %% name="starts at 0" origin="new" sentence="The first component has the number 1; 0 is the background. So set the count before you use it." must_say=["number 1|first component|background|one too low"] kind="value"
def label(mask):
    labels = np.full(mask.shape, -1)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == -1:
            stack = [tuple(start)]
            while stack:
                row, col = stack.pop()
                if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == -1:
                    labels[row, col] = count
                    stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
            count += 1
    return labels

# %% name="return inside the loop" origin="new" sentence="return stands inside the loop: only the first component gets its number." must_say=["first component|return"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == 0:
            count += 1
            stack = [tuple(start)]
            while stack:
                row, col = stack.pop()
                if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == 0:
                    labels[row, col] = count
                    stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
            return labels

# %% name="range stops before 1" origin="new" sentence="range(-1, 1) is -1 and 0: the neighbours to the right and below are missing." must_say=["eight|neighbours"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == 0:
            count += 1
            stack = [tuple(start)]
            while stack:
                row, col = stack.pop()
                if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == 0:
                    labels[row, col] = count
                    stack += [(row + i, col + j) for i in range(-1, 1) for j in range(-1, 1)]
    return labels

# %% name="without border" origin="new" sentence="The border pixels belong to the image: row 0, column 0 and the last ones." must_say=["border|row 0|last row"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    rows, cols = mask.shape
    for row0, col0 in np.argwhere(mask):
        if labels[row0, col0] or not (0 < row0 < rows - 1 and 0 < col0 < cols - 1):
            continue
        count += 1
        stack = [(row0, col0)]
        while stack:
            row, col = stack.pop()
            if 0 < row < rows - 1 and 0 < col < cols - 1 and mask[row, col] and labels[row, col] == 0:
                labels[row, col] = count
                stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return labels

# %% name="paper" origin="new" sentence="True is ink: you labelled the pixels that are False." must_say=["ink|True|paper"] kind="value"
def label(mask):
    mask = mask == False
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == 0:
            count += 1
            stack = [tuple(start)]
            while stack:
                row, col = stack.pop()
                if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == 0:
                    labels[row, col] = count
                    stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return labels

# %% name="columns first" origin="new" sentence="Go row by row: your outer loop runs over the columns." must_say=["row by row|columns"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for c in range(mask.shape[1]):
        for r in range(mask.shape[0]):
            if mask[r, c] and labels[r, c] == 0:
                count += 1
                stack = [(r, c)]
                while stack:
                    row, col = stack.pop()
                    if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == 0:
                        labels[row, col] = count
                        stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return labels

# %% name="all ink is 1" origin="new" sentence="Each component needs a number of its own: add 1 to the count." must_say=["number of its own|add 1|count"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    for start in np.argwhere(mask):
        stack = [tuple(start)]
        while stack:
            row, col = stack.pop()
            if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == 0:
                labels[row, col] = 1
                stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return labels
