# %% name="difference and square in uint8" origin="walk" sentence="clean - other stays uint8 and wraps around below 0 (and its square above 255): widen with astype(float) before you subtract." must_say=["uint8|wrap|below 0", "widen|astype|float|\\bint\\b"] must_not_say=["log", "max"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean - other) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255**2 / mse)

# %% name="loop subtracts in uint8" origin="walk" sentence="clean[y, x] - other[y, x] is uint8 minus uint8 and wraps around below 0: turn both into int() or float() first." must_say=["uint8|wrap|below 0|negative", "int\\(|float\\(|\\bint\\b|widen|astype|float"] kind="value"
def my_psnr(clean, other):
    import warnings

    total = 0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for y in range(clean.shape[0]):
            for x in range(clean.shape[1]):
                difference = clean[y, x] - other[y, x]
                total += int(difference) ** 2
    if total == 0:
        return float("inf")
    return 10 * np.log10(255**2 * clean.size / total)

# %% name="widened after subtracting" origin="walk" sentence="The subtraction happens before astype(float), still in uint8, and has wrapped already: widen clean before you subtract other." must_say=["before|after|too late|already|first", "uint8|wrap", "widen|astype|float"] kind="value"
def my_psnr(clean, other):
    squared = (clean - other).astype(float) ** 2
    mse = squared.mean()
    return float("inf") if mse == 0 else float(10 * np.log10(255**2 / mse))

# %% name="infinity not handled" origin="new" sentence="For equal images the MSE is 0 and you divide by 0: return float(\"inf\") in that case first." must_say=["equal|same|identical|MSE is 0|zero", "inf", "divi|first|case|return|check"] must_not_say=["uint8", "wrap"] kind="error"
def my_psnr(clean, other):
    mse = float(np.mean((clean.astype(float) - other) ** 2))
    return 10 * np.log10(255**2 / mse)

# %% name="natural logarithm" origin="new" sentence="np.log is the natural logarithm; decibels need the logarithm to base 10, np.log10." must_say=["natural|np\\.log\\b(?!10)", "log10|base 10"] must_not_say=["uint8", "wrap"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log(255**2 / mse)

# %% name="255 not squared" origin="new" sentence="The largest value stands squared in the formula: 255**2 / mse, not 255 / mse." must_say=["squared? in|255 ?\\*\\* ?2|65025|255²|square", "255", "not 255|largest|peak|squared in|squared|missing|forg"] must_not_say=["wrap"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(255 / mse))

# %% name="20 instead of 10" origin="new" sentence="20 belongs to 255 / sqrt(MSE); with 255**2 / MSE the factor is 10." must_say=["\\b20\\b|factor|twice|double", "\\b10\\b|sqrt|root"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return float(20 * np.log10(255**2 / mse))

# %% name="fraction upside down" origin="new" sentence="You divide the MSE by 255**2, so the result is negative: the fraction is 255**2 / mse." must_say=["upside|invert|negative|sign|swap|turned|wrong way|exchang|reciprocal", "255"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(mse / 255**2))

# %% name="maximum of the image" origin="new" sentence="The peak is 255, the largest value that a pixel can have, not the largest value of this image." must_say=["\\bmax\\b|largest|peak|brightest", "always|any pixel|a pixel can|possible|this image|the image|clean\\.max|not the"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(float(clean.max()) ** 2 / mse))

# %% name="mean of absolute differences" origin="new" sentence="You take the absolute difference; the mean squared error needs the square of each difference." must_say=["absolute|\\babs\\b", "squar|\\*\\* ?2"] must_not_say=["uint8"] kind="value"
def my_psnr(clean, other):
    error = np.abs(clean.astype(float) - other).mean()
    if error == 0:
        return float("inf")
    return float(10 * np.log10(255**2 / error))

# %% name="square of the mean" origin="new" sentence="You square the mean of the differences, in which plus and minus cancel: square each difference first, then take the mean." must_say=["mean", "square (the|each|first)|square of the mean|\\*\\* ?2|cancel", "cancel|first|before|then"] must_not_say=["uint8"] kind="value"
def my_psnr(clean, other):
    mse = (clean.astype(float) - other).mean() ** 2
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(255**2 / mse))

# %% name="sum instead of mean" origin="new" sentence="You add the squared differences up and do not divide by the number of pixels: take the mean." must_say=["\\bsum\\b|adds? .*up|number of pixels|not divid", "\\bmean\\b|number of pixels|size"] kind="value"
def my_psnr(clean, other):
    sse = ((clean.astype(float) - other) ** 2).sum()
    if sse == 0:
        return float("inf")
    return float(10 * np.log10(255**2 / sse))

# %% name="returns the MSE" origin="new" sentence="You return the mean squared error; put it into the formula, 10 times the logarithm of 255**2 / mse." must_say=["MSE|mean squared", "formula|logarithm|decibel|10 times", "return|put|still|missing|itself"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return float(mse)

# %% name="inf as text" origin="new" sentence="\"inf\" in quotes is a text; the number infinity is float(\"inf\")." must_say=["text|string|\\bstr\\b|quot", "float\\(|number infinity|infinity|inf"] kind="type"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return "inf"
    return float(10 * np.log10(255**2 / mse))

# %% name="0 for equal images" origin="new" sentence="Equal images have no noise at all, so the PSNR is infinite, not 0: return float(\"inf\")." must_say=["equal|same|identical", "infinit|\"inf\"", "not 0|no noise|\\b0\\b|instead|0\\.0"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return 0.0
    return float(10 * np.log10(255**2 / mse))

# %% name="rounded to one digit" origin="new" sentence="You round the result to one digit as the lesson does when it prints; return the whole float and leave round() out." must_say=["\\bround", "digit|exact|leave|full|print|whole float"] must_not_say=["wrap"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return round(float(10 * np.log10(255**2 / mse)), 1)

# %% name="printed with dB" origin="new" sentence="You print the value and return nothing: give the number back with return." must_say=["print", "return"] kind="no-return"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        print("inf dB")
    else:
        print(10 * np.log10(255**2 / mse), "dB")

# %% name="text with the unit" origin="new" sentence="You return a text with dB at the end; return the number alone, as a float." must_say=["\\bdB\\b|unit", "number|float"] kind="type"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return f"{10 * np.log10(255**2 / mse):.1f} dB"

# %% name="an array, one value for each row" origin="new" sentence="mean(axis=1) gives one value for each row: leave the axis out to get one mean of all pixels." must_say=["axis|each row|per row|array", "one (number|value|mean)|all pixels|whole image|single|float"] kind="type"
def my_psnr(clean, other):
    mse = ((clean.astype(float) - other) ** 2).mean(axis=1)
    if (mse == 0).all():
        return float("inf")
    return 10 * np.log10(255**2 / np.maximum(mse, 1e-9))

# %% name="^ as a power" origin="new" sentence="In Python ^ is not a power: write ** 2." must_say=["\\^|power|xor", "\\*\\*|square"] kind="error"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ^ 2)
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(255**2 / mse))

# %% name="widened to int8" origin="new" sentence="int8 ends at 127, so values above are changed: widen to a larger type, astype(float) or astype(int)." must_say=["\\bint8\\b|127", "float|larger|wider|int16|int32"] kind="value"
def my_psnr(clean, other):
    difference = clean.astype(np.int8) - other.astype(np.int8)
    mse = np.mean(difference.astype(float) ** 2)
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(255**2 / mse))

# %% name="int16 squares overflow" origin="new" sentence="The difference fits into int16, but its square, up to 65025, does not (int16 ends at 32767): widen to float or int32." must_say=["int16|32767", "float|int32|int64|wider"] kind="value"
def my_psnr(clean, other):
    difference = clean.astype(np.int16) - other.astype(np.int16)
    mse = np.mean(difference**2)
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(255**2 / mse))

# %% name="the course's psnr without an import" origin="new" sentence="psnr is the course's function from another cell, and this task asks you to compute the value yourself: mean squared error, then the logarithm." must_say=["\\bpsnr\\b", "yourself|import|compute|cell|refus"] kind="other-cell"
def my_psnr(clean, other):
    return psnr(clean, other)

# %% name="log10 without its module" origin="new" sentence="The name math is not known in this cell: write import math, or use np.log10." must_say=["math", "import|np\\.log10|numpy"] kind="missing-import"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * math.log10(255**2 / mse)

# %% name="integer division" origin="new" sentence="// drops the fraction of 255**2 / mse: divide with a single /." must_say=["//|integer division|floor", "/|float"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(255**2 // mse))

# %% name="whole arrays compared in an if" origin="new" sentence="clean == other compares pixel by pixel and gives an array: put (clean == other).all() or np.array_equal into the if." must_say=["array|pixel by pixel|each pixel", "all|array_equal|any"] kind="error"
def my_psnr(clean, other):
    if clean == other:
        return float("inf")
    mse = np.mean((clean.astype(float) - other) ** 2)
    return float(10 * np.log10(255**2 / mse))

# %% name="equal sums taken for equal images" origin="new" sentence="Two different images can have the same sum, and you return infinity for them: ask whether the MSE is 0." must_say=["\\bsum", "MSE|each pixel|every pixel|array_equal|all\\(|differ"] must_not_say=["wrap"] kind="value"
def my_psnr(clean, other):
    if clean.sum() == other.sum():
        return float("inf")
    mse = np.mean((clean.astype(float) - other) ** 2)
    return float(10 * np.log10(255**2 / mse))

# %% name="small errors taken for none" origin="new" sentence="mse < 1 is true for images that differ a little, and only equal images have an infinite PSNR: compare with 0." must_say=["< ?1|small|little|below 1", "\\b0\\b|equal|zero"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2)
    if mse < 1:
        return float("inf")
    return float(10 * np.log10(255**2 / mse))

# %% name="size of the lesson's frame" origin="new" sentence="You divide by 720 * 1280, the size of the lesson's frame: divide by the size of this image, or use mean." must_say=["720|1280|lesson|fixed|hard", "mean|size|number of pixels|shape"] kind="value"
def my_psnr(clean, other):
    mse = ((clean.astype(float) - other) ** 2).sum() / (720 * 1280)
    if mse == 0:
        return float("inf")
    return float(10 * np.log10(255**2 / mse))
