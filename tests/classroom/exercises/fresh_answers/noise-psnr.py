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

# %% name="uint8 difference" origin="fresh" sentence="The difference is taken in uint8 and wraps around: widen first." must_say=["float|widen|wrap"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean - other) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255 ** 2 / mse)

# %% name="parentheses of the square" origin="fresh" sentence="Only other is squared: put the difference in parentheses." must_say=["parenthes|square"] kind="value"
def my_psnr(clean, other):
    mse = np.mean(clean.astype(float) - other.astype(float) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255 ** 2 / mse)

# %% name="natural logarithm" origin="fresh" sentence="np.log is the natural logarithm: use np.log10." must_say=["log10|base 10"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log(255 ** 2 / mse)

# %% name="20 without root" origin="fresh" sentence="20 belongs to the square root of the mse: write 10, or take the root." must_say=["root|twice|2 times|10"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    if mse == 0:
        return float("inf")
    return 20 * np.log10(255 ** 2 / mse)

# %% name="sum for mean" origin="fresh" sentence="np.sum adds all squares; the mse is their mean." must_say=["mean|sum"] kind="value"
def my_psnr(clean, other):
    mse = np.sum((clean.astype(float) - other.astype(float)) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255 ** 2 / mse)

# %% name="no infinity" origin="fresh" sentence="For equal images return float(\"inf\") before you divide." must_say=["inf"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    return 0.0 if mse == 0 else 10 * np.log10(255 ** 2 / mse)

# %% name="print" origin="fresh" sentence="print shows the number; write return." must_say=["return"] kind="no-return"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    if mse == 0:
        return float("inf")
    print(10 * np.log10(255 ** 2 / mse))

# %% name="caret" origin="fresh" sentence="^ is not a power: write ** 2." must_say=["\\*\\*"] kind="error"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ^ 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255 ** 2 / mse)

# %% name="255 not squared" origin="fresh" sentence="In the formula 255 is squared." must_say=["255|square"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255 / mse)

# %% name="fraction upside down again" origin="fresh" sentence="The fraction is upside down: 255**2 divided by the mse." must_say=["sign|upside down|divided by"] kind="value"
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other.astype(float)) ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(mse / 255 ** 2)

# %% name="Subtracts in uint8 and converts only afterwards" origin="fresh" sentence="Subtracts in uint8 and converts only afterwards, so negative differences have already wrapped around." must_say=["uint8"] kind="value"
def my_psnr(clean, other):
    difference = (clean - other).astype(float)
    mse = np.mean(difference ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255 ** 2 / mse)

# %% name="Equal images are not treated" origin="fresh" sentence="Equal images are not treated: the mean square error is 0 and the division fails." must_say=["MSE is 0|error is 0"] kind="error"
import math

def my_psnr(clean, other):
    difference = clean.astype(float) - other.astype(float)
    mse = float((difference ** 2).mean())
    return 10 * math.log10(255 ** 2 / mse)

# %% name="np" origin="fresh" sentence="np.log is the natural logarithm; the formula needs the logarithm to base 10." must_say=["natural"] kind="value"
def my_psnr(clean, other):
    difference = clean.astype(float) - other.astype(float)
    mse = np.mean(difference ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log(255 ** 2 / mse)

# %% name="255 is not squared" origin="fresh" sentence="255 is not squared." must_say=["squared"] kind="value"
def my_psnr(clean, other):
    difference = clean.astype(np.int32) - other.astype(np.int32)
    mse = np.mean(difference ** 2)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255 / mse)

# %% name="Uses the factor 20 together with 255 squared over the mean" origin="fresh" sentence="Uses the factor 20 together with 255 squared over the mean square error, so the result is twice too large." must_say=["twice"] kind="value"
def my_psnr(clean, other):
    difference = clean.astype(float) - other.astype(float)
    mse = (difference ** 2).mean()
    if mse == 0:
        return float("inf")
    return 20 * np.log10(255 ** 2 / mse)

# %% name="Rounds the result to two digits although it must not be" origin="fresh" sentence="Rounds the result to two digits although it must not be rounded." must_say=["round"] kind="value"
def my_psnr(clean, other):
    difference = clean.astype(float) - other.astype(float)
    mse = (difference ** 2).mean()
    if mse == 0:
        return float("inf")
    psnr = 10 * np.log10(255 ** 2 / mse)
    return round(psnr, 2)

# %% name="Takes the sum of the squares instead of their mean" origin="fresh" sentence="Takes the sum of the squares instead of their mean." must_say=["sum of"] kind="value"
def my_psnr(clean, other):
    difference = clean.astype(float) - other.astype(float)
    error = np.sum(difference ** 2)
    if error == 0:
        return float("inf")
    return 10 * np.log10(255 ** 2 / error)

# %% name="math is used but not imported in the cell" origin="fresh" sentence="math is used but not imported in the cell." must_say=["import"] kind="missing-import"
def my_psnr(clean, other):
    difference = clean.astype(float) - other.astype(float)
    mse = np.mean(difference ** 2)
    if mse == 0:
        return float("inf")
    return 10 * math.log10(255 ** 2 / mse)

# %% name="For equal images the text \"inf\" is returned" origin="fresh" sentence="For equal images the text \"inf\" is returned, not the number float(\"inf\")." must_say=["text"] kind="type"
def my_psnr(clean, other):
    difference = clean.astype(float) - other.astype(float)
    mse = np.mean(difference ** 2)
    if mse == 0:
        return "inf"
    else:
        return 10 * np.log10(255 ** 2 / mse)

# %% name="Averages the absolute differences instead of the squared" origin="fresh" sentence="Averages the absolute differences instead of the squared differences." must_say=["absolute"] kind="value"
def my_psnr(clean, other):
    difference = np.abs(clean.astype(float) - other.astype(float))
    mse = np.mean(difference)
    if mse == 0:
        return float("inf")
    return 10 * np.log10(255 ** 2 / mse)
