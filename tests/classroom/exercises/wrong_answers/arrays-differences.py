# %% name="np.diff along the wrong axis" sentence="axis=0 goes down the rows; the right neighbour is along axis 1." must_say=["axis|column|row"] kind="shape"
def differences(gray):
    return np.diff(gray.astype(np.int16), axis=0)

# %% name="slices of different length" sentence="The two slices have different lengths: both must have one column less than the image." must_say=["broadcast|shape|length|differ", "column|slice|same|one (column )?less|:-1|shape"] kind="error"
def differences(gray):
    wide = gray.astype(np.int16)
    return wide[:, 1:] - wide[:, :-2]
