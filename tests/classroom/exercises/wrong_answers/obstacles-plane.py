# %% name="never turned" sentence="If the normal points down, turn it: its y must be negative." must_say=["down|up|turn|opposite"] kind="value"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    return normal, -(normal @ a)
