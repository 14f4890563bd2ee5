# %% name="not divided" origin="new" sentence="The normal must be 1 long: divide it by its length." must_say=["length|1 long"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="never turned" origin="new" sentence="If the normal points down, turn it: its y must be negative." must_say=["down|up|turn|opposite"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    return normal, -(normal @ a)

# %% name="turned the wrong way" origin="new" sentence="Up is where y is negative, so turn the normal if normal[1] > 0." must_say=["negative|> 0|down"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] < 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="offset too early" origin="new" sentence="You computed the offset before you turned the normal: compute it at the end." must_say=["before|final|turn"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    offset = -(normal @ a)
    if normal[1] > 0:
        normal = -normal
    return normal, offset

# %% name="offset positive" origin="new" sentence="The offset is minus normal @ a, so that a has the height 0." must_say=["minus|sign|-\\("] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, normal @ a

# %% name="cross of points" origin="new" sentence="Take the cross product of b - a and c - a, not of the points." must_say=["b - a|direction|differences"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(a, b)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="abs" origin="new" sentence="abs changes single signs: turn the whole vector with -normal." must_say=["whole vector|sign|-normal"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    normal = -np.abs(normal)
    return normal, -(normal @ a)

# %% name="element-wise offset" origin="new" sentence="normal * a is element-wise: use normal @ a, which is one number." must_say=["@|dot|one number|sum|adds"] kind="type"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal * a)

# %% name="only the normal" origin="new" sentence="The task asks for two values: the offset is missing." must_say=["two|offset|2"] kind="type"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal

# %% name="four numbers in one array" origin="new" sentence="Return two values, the normal and the offset, not one array of four." must_say=["two|2"] kind="type"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return np.append(normal, -(normal @ a))

# %% name="sum of squares" origin="new" sentence="The length is the root of the sum of squares: np.linalg.norm." must_say=["root|norm|length"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / (normal ** 2).sum()
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="only y turned" origin="new" sentence="Turn the whole vector, not only its y." must_say=["whole"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal[1] = -normal[1]
    return normal, -(normal @ a)

# %% name="b - a twice" origin="new" sentence="The cross product of a vector with itself is 0: take b - a and c - a." must_say=["c - a|itself|0|direction"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, b - a)
    length = np.linalg.norm(normal)
    normal = normal / max(length, 1e-9)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="offset first" origin="new" sentence="The normal comes first, then the offset." must_say=["order|first|exchang"] kind="type"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return -(normal @ a), normal

# %% name="dot product instead" origin="new" sentence="np.dot gives one number; the vector that is perpendicular to both is np.cross." must_say=["cross"] kind="error"
def plane_of(a, b, c):
    normal = np.dot(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="norm without linalg" origin="new" sentence="norm is in np.linalg: np.linalg.norm(normal)." must_say=["linalg"] kind="error"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="divided by normal.sum()" origin="new" sentence="The length is np.linalg.norm(normal), not the sum." must_say=["sum", "length|norm"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / normal.sum()
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)
