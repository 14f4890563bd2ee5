# %% name="never turned" sentence="If the normal points down, turn it: its y must be negative." must_say=["down|up|turn|opposite"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    return normal, -(normal @ a)

# %% name="element-wise offset" sentence="normal * a is element-wise: use normal @ a, which is one number." must_say=["@|dot|one number|sum|adds"] kind="type"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal * a)

# %% name="dot product instead" sentence="np.dot gives one number; the vector that is perpendicular to both is np.cross." must_say=["cross"] kind="error"
def plane_of(a, b, c):
    normal = np.dot(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="abs" sentence="abs changes single signs: turn the whole vector with -normal." must_say=["whole vector|sign|-normal"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    normal = -np.abs(normal)
    return normal, -(normal @ a)

# %% name="divided by normal.sum()" sentence="The length is np.linalg.norm(normal), not the sum." must_say=["sum", "length|norm"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / normal.sum()
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)
