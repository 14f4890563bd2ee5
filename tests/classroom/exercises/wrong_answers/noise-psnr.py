# %% name="widened after subtracting" sentence="The subtraction happens before astype(float), still in uint8, and has wrapped already: widen clean before you subtract other." must_say=["before|after|too late|already|first", "uint8|wrap", "widen|astype|float"] kind="value"
def my_psnr(clean, other):
    squared = (clean - other).astype(float) ** 2
    mse = squared.mean()
    return float("inf") if mse == 0 else float(10 * np.log10(255**2 / mse))

# %% name="the course's psnr without an import" sentence="psnr is the course's function from another cell, and this task asks you to compute the value yourself: mean squared error, then the logarithm." must_say=["\\bpsnr\\b", "yourself|import|compute|cell|refus"] kind="other-cell"
def my_psnr(clean, other):
    return psnr(clean, other)

# %% name="infinity not handled" sentence="For equal images the MSE is 0 and you divide by 0: return float(\"inf\") in that case first." must_say=["equal|same|identical|MSE is 0|zero", "inf", "divi|first|case|return|check"] must_not_say=["uint8", "wrap"] kind="error"
def my_psnr(clean, other):
    mse = float(np.mean((clean.astype(float) - other) ** 2))
    return 10 * np.log10(255**2 / mse)

# %% name="inf as text" sentence="\"inf\" in quotes is a text; the number infinity is float(\"inf\")." must_say=["text|string|\\bstr\\b|quot", "float\\(|number infinity|infinity|inf"] kind="type"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return "inf"
    return float(10 * np.log10(255**2 / mse))

# %% name="log10 without its module" sentence="The name math is not known in this cell: write import math, or use np.log10." must_say=["math", "import|np\\.log10|numpy"] kind="missing-import"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * math.log10(255**2 / mse)
