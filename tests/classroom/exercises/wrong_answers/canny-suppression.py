# %% name="mask instead of magnitudes" sentence="You return a mask of True and False; the task wants int32: the magnitude where a pixel survives, and 0 elsewhere." must_say=["mask|bool|True", "magnitude|int32"] kind="dtype"
def suppress(magnitude, sector):
    p = np.pad(magnitude, 1)
    h, w = magnitude.shape

    def at(dy, dx):
        return p[1 + dy : 1 + dy + h, 1 + dx : 1 + dx + w]

    m = magnitude
    keep = [(m > at(0, -1)) & (m >= at(0, 1)), (m > at(-1, -1)) & (m > at(1, 1)),
            (m > at(-1, 0)) & (m >= at(1, 0)), (m > at(-1, 1)) & (m > at(1, -1))]
    return np.choose(sector, keep)
