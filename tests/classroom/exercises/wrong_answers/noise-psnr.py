# %% name="the course's psnr without an import" sentence="psnr is the course's function from another cell, and this task asks you to compute the value yourself: mean squared error, then the logarithm." must_say=["\\bpsnr\\b", "yourself|import|compute|cell|refus"] kind="other-cell"
def my_psnr(clean, other):
    return psnr(clean, other)

# %% name="inf as text" sentence="\"inf\" in quotes is a text; the number infinity is float(\"inf\")." must_say=["text|string|\\bstr\\b|quot", "float\\(|number infinity|infinity|inf"] kind="type"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return "inf"
    return float(10 * np.log10(255**2 / mse))
