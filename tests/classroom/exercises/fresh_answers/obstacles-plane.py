# %% name="divided by the length of b - a" origin="fresh" sentence="Divide by the length of the normal itself." must_say=["length|norm"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(b - a)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="mean of the points as the offset" origin="fresh" sentence="The offset is one number, measured along the normal: -(normal @ a)." must_say=["offset|normal @ a"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, float(np.mean([a[1], b[1], c[1]]))

# %% name="sum of the points" origin="fresh" sentence="b + a is no direction in the plane: subtract." must_say=["subtract|minus|b - a|difference|direction"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b + a, c + a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, -(normal @ a)

# %% name="always turned" origin="fresh" sentence="You turn the normal always, also if it points up already." must_say=["turn|up|if|down|opposite"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    normal = -normal
    return normal, -(normal @ a)

# %% name="rounded" origin="fresh" sentence="Return the exact numbers: leave round out." must_say=["round|exact"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal.round(2), round(-(normal @ a), 2)
