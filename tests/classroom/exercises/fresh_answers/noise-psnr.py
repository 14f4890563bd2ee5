# %% name="peak is the maximum of the image" origin="fresh" sentence="The peak is 255, not the largest value of the image." must_say=["255|peak|largest"] must_not_say=["uint8|wrap|log2|natural"] kind="value"
def my_psnr(clean, other):
    error = clean.astype(np.float64) - other.astype(np.float64)
    mse = (error ** 2).mean()
    if mse == 0:
        return float("inf")
    peak = clean.max()
    return 10 * np.log10(float(peak) ** 2 / mse)

# %% name="root of the error" origin="fresh" sentence="The formula uses the MSE; you take its square root." must_say=["root|sqrt|MSE|square"] must_not_say=["uint8|wrap"] kind="value"
def my_psnr(clean, other):
    error = clean.astype(float) - other.astype(float)
    rmse = np.sqrt((error ** 2).mean())
    if rmse == 0:
        return float("inf")
    return 10 * np.log10(255 ** 2 / rmse)

# %% name="squares in int16" origin="fresh" sentence="A squared error can be 65025, too large for int16: use int32 or float." must_say=["int16|int32|float|wrap|32767|widen|overflow"] must_not_say=["natural|log10"] kind="value"
def my_psnr(clean, other):
    error = clean.astype(np.int16) - other.astype(np.int16)
    mse = np.mean(error * error)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255 ** 2 / mse)

# %% name="fraction upside down" origin="fresh" sentence="The fraction is upside down: 255² / MSE, so your result has the wrong sign." must_say=["upside|sign|negative|invert|255|fraction|divide|exchang|swap"] must_not_say=["uint8|wrap|log base"] kind="value"
def my_psnr(clean, other):
    error = clean.astype(float) - other.astype(float)
    mse = (error ** 2).mean()
    if mse == 0:
        return float("inf")
    return 10 * np.log10(mse / 255 ** 2)

# %% name="0 for equal images" origin="fresh" sentence="For equal images the result is infinity, float(\"inf\"), not 0." must_say=["\\binf|equal images"] must_not_say=["uint8|wrap"] kind="value"
def my_psnr(clean, other):
    error = clean.astype(float) - other.astype(float)
    mse = (error ** 2).mean()
    if mse == 0:
        return 0
    return 10 * np.log10(255 ** 2 / mse)
