# %% [markdown]
# # noise-median

# %%
def nine_neighbours(gray, mode="edge"):
    height, width = gray.shape
    padded = np.pad(gray, 1, mode=mode)
    return np.array([padded[row : row + height, col : col + width] for row in range(3) for col in range(3)])

def medians_of_windows(gray, of_window):
    """of_window applied to the part of each neighbourhood that lies in the image."""
    result = np.empty_like(gray)
    for row, col in np.ndindex(gray.shape):
        result[row, col] = of_window(gray[max(row - 1, 0) : row + 2, max(col - 1, 0) : col + 2])
    return result

# %% role="mistake" name="a mean instead of a median" says="This is the mean of the nine values. It spreads a wrong pixel over its neighbours. The median is the fifth of the nine values when they are sorted."
def median3(gray):
    return np.mean(nine_neighbours(gray), axis=0).astype(np.uint8)

# %% role="mistake" name="a rounded mean" says="This is the mean of the nine values. It spreads a wrong pixel over its neighbours. The median is the fifth of the nine values when they are sorted."
def median3(gray):
    return np.round(np.mean(nine_neighbours(gray), axis=0)).astype(np.uint8)

# %% role="mistake" name="a weighted mean" says="This is a weighted mean, as in the Gaussian filter. It spreads a wrong pixel over its neighbours. The median is the fifth of the nine values when they are sorted."
def median3(gray):
    weights = np.array([1, 2, 1, 2, 4, 2, 1, 2, 1])[:, np.newaxis, np.newaxis]
    return ((nine_neighbours(gray) * weights).sum(axis=0) // 16).astype(np.uint8)

# %% role="mistake" name="the middle between the smallest and the largest" says="This is the middle between the smallest and the largest of the nine values. The median is the fifth of the nine values when they are sorted."
def median3(gray):
    nine = nine_neighbours(gray).astype(int)
    return ((nine.min(axis=0) + nine.max(axis=0)) // 2).astype(np.uint8)

# %% role="mistake" name="a sum in uint8" says="This is a mean, and its sum of nine values ran past 255 in uint8. The task asks for the median: sort the nine values and take the middle one."
def median3(gray):
    return nine_neighbours(gray).sum(axis=0, dtype=np.uint8) // 9

# %% role="mistake" name="zero padding at the border" says="At the border the missing neighbours are zeros, as with zero padding. These zeros change the medians. Repeat the outermost rows and columns: np.pad(gray, 1, mode='edge')."
def median3(gray):
    return np.median(nine_neighbours(gray, "constant"), axis=0).astype(np.uint8)

# %% role="mistake" name="reflected border" says="At the border the missing neighbours are mirrored (reflect-101), so the second row stands above the first. Replicate repeats the outermost row and column: use mode='edge'."
def median3(gray):
    return np.median(nine_neighbours(gray, "reflect"), axis=0).astype(np.uint8)

# %% role="mistake" name="wrapped border" says="At the border the missing neighbours come from the opposite side of the image. np.roll and an index of -1 do this. Repeat the outermost rows and columns instead: np.pad(gray, 1, mode='edge')."
def median3(gray):
    return np.median(nine_neighbours(gray, "wrap"), axis=0).astype(np.uint8)

# %% role="mistake" name="border left at 0" says="The pixels at the border are 0: only the inner pixels got a median. Pad the image with its outermost rows and columns first, np.pad(gray, 1, mode='edge'), and then visit every pixel."
def median3(gray):
    result = np.zeros_like(gray)
    result[1:-1, 1:-1] = solution(gray)[1:-1, 1:-1]
    return result

# %% role="mistake" name="border copied" says="The pixels at the border are unchanged, but they need a median too. Repeat the outermost rows and columns with np.pad(gray, 1, mode='edge'), and visit every pixel."
def median3(gray):
    result = gray.copy()
    result[1:-1, 1:-1] = solution(gray)[1:-1, 1:-1]
    return result

# %% role="mistake" name="border not padded, middle of the sorted rest" says="At the border your neighbourhood has fewer than nine values: four in a corner, six at a side. Repeat the outermost rows and columns with np.pad(gray, 1, mode='edge'), so that every pixel has nine."
def median3(gray):
    return medians_of_windows(gray, lambda window: np.sort(window, axis=None)[window.size // 2])

# %% role="mistake" name="read from the array that is written" says="Some neighbours were already replaced by their medians before they were used: you read from the same array that you write to. Write the medians into a new array."
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    for row, col in np.ndindex(gray.shape):
        padded[row + 1, col + 1] = np.median(padded[row : row + 3, col : col + 3])
    return padded[1:-1, 1:-1].copy()

# %% role="mistake" name="read from the copy that is written" says="Some neighbours were already replaced by their medians before they were used: you read from the same array that you write to. Write the medians into a new array, and visit the border, too."
def median3(gray):
    result = gray.copy()
    for row in range(1, gray.shape[0] - 1):
        for col in range(1, gray.shape[1] - 1):
            result[row, col] = np.median(result[row - 1 : row + 2, col - 1 : col + 2])
    return result

# %% role="mistake" name="the result made anew in the loop" says="Only the last pixel has its median; all others are 0. If the result array is made inside the loops, it begins anew for each pixel: make it once, before the loops."
def median3(gray):
    result = np.zeros_like(gray)
    result[-1, -1] = solution(gray)[-1, -1]
    return result

# %% role="mistake" name="the largest value" says="This is the largest of the nine values. The median is the fifth of the nine values when they are sorted."
def median3(gray):
    return nine_neighbours(gray).max(axis=0)

# %% role="mistake" name="the smallest value" says="This is the smallest of the nine values. The median is the fifth of the nine values when they are sorted."
def median3(gray):
    return nine_neighbours(gray).min(axis=0)

# %% role="mistake" name="only neighbours in the row" says="This is the median of three values of one row. A neighbourhood has nine values: the rows above and below belong to it, too. (np.sort without axis=None sorts each row alone.)"
def median3(gray):
    return np.median(nine_neighbours(gray)[3:6], axis=0).astype(np.uint8)

# %% role="mistake" name="only neighbours in the column" says="This is the median of three values of one column. A neighbourhood has nine values: the columns on the left and on the right belong to it, too."
def median3(gray):
    return np.median(nine_neighbours(gray)[1::3], axis=0).astype(np.uint8)

# %% role="mistake" name="a cross of five" says="This is the median of five values: the pixel and its neighbours above, below, left and right. The four neighbours at the corners belong to the neighbourhood, too: it has nine values."
def median3(gray):
    return np.median(nine_neighbours(gray)[[1, 3, 4, 5, 7]], axis=0).astype(np.uint8)

# %% role="mistake" name="rows first, then columns" says="This is a median of medians: three rows first, then the three results. It is not always the median of all nine values. Sort the nine together."
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    rows = np.median([padded[:, :-2], padded[:, 1:-1], padded[:, 2:]], axis=0)
    return np.median([rows[:-2], rows[1:-1], rows[2:]], axis=0).astype(np.uint8)

# %% role="mistake" name="columns first, then rows" says="This is a median of medians: three columns first, then the three results. It is not always the median of all nine values. Sort the nine together."
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    columns = np.median([padded[:-2], padded[1:-1], padded[2:]], axis=0)
    return np.median([columns[:, :-2], columns[:, 1:-1], columns[:, 2:]], axis=0).astype(np.uint8)

# %% role="mistake" name="a window of 2 by 2" says="Your window has two rows and two columns: four values. A slice ends before its last number, so three rows need a difference of 3, as in row : row + 3."
def median3(gray):
    return np.median(nine_neighbours(gray)[[0, 1, 3, 4]], axis=0).astype(np.uint8)

# %% role="mistake" name="a window of 2 by 2 to the right" says="Your window has two rows and two columns: four values. A slice ends before its last number, so three rows need a difference of 3, as in row : row + 3."
def median3(gray):
    return np.median(nine_neighbours(gray)[[4, 5, 7, 8]], axis=0).astype(np.uint8)

# %% role="mistake" name="a window of 5 by 5" says="This is the median of 5 × 5 values. Here the neighbourhood is 3 × 3: pad by one pixel, and take three rows and three columns."
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 2, mode="edge")
    shifted = [padded[row : row + height, col : col + width] for row in range(5) for col in range(5)]
    return np.median(shifted, axis=0).astype(np.uint8)

# %% role="mistake" name="the window of the padded image shifted" says="The window lies one row and one column too far down and right: the pixel (row, col) of gray is at (row + 1, col + 1) of the padded image, so its window is padded[row : row + 3, col : col + 3]."
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, ((1, 3), (1, 3)), mode="edge")
    result = np.empty_like(gray)
    for row, col in np.ndindex(height, width):
        result[row, col] = np.median(padded[row + 1 : min(row + 4, height + 2), col + 1 : min(col + 4, width + 2)])
    return result

# %% role="mistake" name="center left out, upper middle" says="This is a middle value of eight: the pixel itself is missing. The neighbourhood has nine values, and the pixel in the middle is one of them."
def median3(gray):
    return np.sort(np.delete(nine_neighbours(gray), 4, axis=0), axis=0)[4]

# %% role="mistake" name="a flat array" says="You return all medians in one long row. Give the result the shape of the image: reshape(gray.shape), or write each median to result[row, col]."
def median3(gray):
    return solution(gray).ravel()

# %% role="mistake" name="a flat array of integers" says="You return all medians in one long row. Give the result the shape of the image: reshape(gray.shape), or write each median to result[row, col]."
def median3(gray):
    return solution(gray).ravel().astype(int)

# %% role="mistake" name="whole rows" says="Your window has three whole rows. Cut the columns, too: padded[row : row + 3, col : col + 3]."
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    medians = [np.median(padded[row : row + 3]) for row in range(gray.shape[0])]
    return np.repeat(np.array(medians).astype(np.uint8), gray.shape[1]).reshape(gray.shape)

# %% role="mistake" name="median along the columns" says="axis=2 takes the median along the columns of the image. The nine shifted images lie one behind the other along axis 0: use axis=0."
def median3(gray):
    return np.median(nine_neighbours(gray), axis=2).astype(np.uint8)

# %% [markdown]
# # noise-psnr

# %%
def mse_of(clean, other):
    return float(np.mean((clean.astype(float) - other.astype(float)) ** 2))

def psnr_with(mse, peak=255**2):
    return float("inf") if mse == 0 else float(10 * np.log10(peak / mse))

# %% role="mistake" name="subtracted and squared in uint8" says="The squares are uint8 values and wrapped around: uint8 ends at 255, but 20 * 20 is 400. Convert both images with astype(float) before you subtract."
def my_psnr(clean, other):
    return psnr_with(np.mean((clean - other) ** 2))

# %% role="mistake" name="subtracted in uint16" says="uint16 has no negative numbers: 100 - 110 gave 65526. Convert both images with astype(float) before you subtract."
def my_psnr(clean, other):
    return psnr_with(np.mean((clean.astype(np.uint16) - other).astype(float) ** 2))

# %% role="mistake" name="the logarithm to base 2" says="np.log2 is the logarithm to base 2. Decibels use the logarithm to base 10: np.log10."
def my_psnr(clean, other):
    mse = mse_of(clean, other)
    return psnr_with(mse) if mse == 0 else float(10 * np.log2(255**2 / mse))

# %% role="mistake" name="not times 10" says="The factor 10 in front of the logarithm is missing: a decibel is a tenth of a bel."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other)) / 10

# %% role="mistake" name="a peak of 256" says="The largest gray level is 255, not 256: the formula needs 255**2 / MSE."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other), 256**2)

# %% role="mistake" name="a peak of 1" says="The peak of a uint8 image is 255, not 1: the formula needs 255**2 / MSE."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other), 1)

# %% role="mistake" name="twice too large" says="The result is twice too large. With 255**2 / MSE the factor is 10; the factor 20 belongs to 255 divided by the square root of the MSE."
def my_psnr(clean, other):
    return 2 * psnr_with(mse_of(clean, other))

# %% role="mistake" name="20 without the root" says="The MSE must not be squared: write 10 * np.log10(255**2 / mse). (The factor 20 belongs to 255 divided by the square root of the MSE.)"
def my_psnr(clean, other):
    mse = mse_of(clean, other)
    return psnr_with(mse) if mse == 0 else float(20 * np.log10(255 / mse))

# %% role="mistake" name="half as large" says="The result is half as large as it should be. With 255 divided by the square root of the MSE the factor is 20; with 255**2 / MSE it is 10."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other)) / 2

# %% role="mistake" name="10 inside the logarithm" says="The factor 10 is inside the logarithm. It belongs in front of it: 10 * np.log10(255**2 / mse)."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other), 10 * 255**2) / 10

# %% role="mistake" name="divided outside the logarithm" says="You divide by the MSE outside the logarithm. The fraction belongs inside: np.log10(255**2 / mse)."
def my_psnr(clean, other):
    mse = mse_of(clean, other)
    return psnr_with(mse) if mse == 0 else float(10 * np.log10(255**2) / mse)

# %% role="mistake" name="images divided by 255" says="You divide the images by 255 and use the peak 255 as well. Leave the images as they are (or use the peak 1 for images from 0 to 1)."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other), 255**4)

# %% role="mistake" name="times 2" says="Each difference is multiplied by 2. The square is ** 2."
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) * 2)
    return psnr_with(mse) if mse >= 0 else float("nan")

# %% role="mistake" name="the root of the MSE" says="You divide by the square root of the MSE. With 255**2 the formula needs the MSE itself."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other) ** 0.5)

# %% role="mistake" name="the largest value of the clean image" says="Your peak is the largest gray level of this image, clean.max(). In the formula it is always 255, the largest value that a pixel can have."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other), float(clean.max()) ** 2)

# %% role="mistake" name="the square of the largest value in uint8" says="clean.max() is a uint8 number, so its square wraps around. The peak in the formula is always 255: write 255**2."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other), float(clean.max() * clean.max()))

# %% role="mistake" name="the largest value of the other image" says="Your peak is the largest gray level of this image, other.max(). In the formula it is always 255, the largest value that a pixel can have."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other), float(other.max()) ** 2)

# %% role="mistake" name="the signal instead of the peak" says="You compare the errors with the mean square of the clean image. PSNR compares them with the square of the peak, always 255**2."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other), np.mean(clean.astype(float) ** 2))

# %% role="mistake" name="absolute differences" says="You take the mean of the absolute differences. The mean squared error needs the square of each difference, then the mean."
def my_psnr(clean, other):
    return psnr_with(np.mean(np.abs(clean.astype(float) - other)))

# %% role="mistake" name="squared mean of absolute differences" says="You take the mean of the absolute differences first and square this mean. Square each difference first, then take the mean."
def my_psnr(clean, other):
    return psnr_with(np.mean(np.abs(clean.astype(float) - other)) ** 2)

# %% role="mistake" name="square of the mean" says="You square the mean of the differences, in which plus and minus cancel. Square each difference first, then take the mean."
def my_psnr(clean, other):
    return psnr_with(np.mean(clean.astype(float) - other) ** 2)

# %% role="mistake" name="variance of the differences" says="This is the variance of the differences: it subtracts their mean first. The MSE is the mean of the squared differences themselves."
def my_psnr(clean, other):
    return psnr_with(np.var(clean.astype(float) - other))

# %% role="mistake" name="size of the lesson's frame" says="You divide by 720 * 1280, the size of the lesson's frame. Divide by the number of pixels of this image, or use np.mean."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other) * clean.size / (720 * 1280))

# %% role="mistake" name="return inside the loop" says="Only the first row of the images was summed. If return is inside the loop over the rows, move it to the left, below the loops."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean[:1], other[:1]) / clean.shape[0])

# %% role="mistake" name="divided by the number of rows" says="You divide the sum by the number of rows only. Divide by the number of pixels, height times width, or use np.mean."
def my_psnr(clean, other):
    return psnr_with(mse_of(clean, other) * clean.shape[1])

# %% role="mistake" name="median of the squares" says="You take the median of the squared differences. The formula needs their mean."
def my_psnr(clean, other):
    return psnr_with(float(np.median((clean.astype(float) - other) ** 2)))

# %% role="mistake" name="the MSE" says="You return the mean squared error itself. Put it into the formula: 10 times the logarithm of 255**2 / MSE."
def my_psnr(clean, other):
    mse = mse_of(clean, other)
    return psnr_with(mse) if mse == 0 else mse

# %% role="mistake" name="the fraction without the logarithm" says="You return 255**2 / MSE itself. The logarithm is missing: 10 * np.log10(255**2 / mse)."
def my_psnr(clean, other):
    mse = mse_of(clean, other)
    return psnr_with(mse) if mse == 0 else 255**2 / mse

# %% role="mistake" name="rounded to a whole number" says="The result has no digits after the point: round() or int() dropped them. Return the float itself."
def my_psnr(clean, other):
    mse = mse_of(clean, other)
    return psnr_with(mse) if mse == 0 else round(psnr_with(mse))

# %% role="mistake" name="the mean as a whole number" says="The fraction of the MSE was dropped: // (integer division) and int() do this. Take np.mean and keep the float."
def my_psnr(clean, other):
    return psnr_with(int(mse_of(clean, other)))

# %% role="mistake" name="minus infinity" says="For equal images you return minus infinity. No noise means the best value, so it is plus infinity: float(\"inf\")."
def my_psnr(clean, other):
    mse = mse_of(clean, other)
    return float("-inf") if mse == 0 else psnr_with(mse)

# %% role="mistake" name="100 for equal images" says="For equal images you return 100. Some programs do so, but here the result must be infinity: return float(\"inf\")."
def my_psnr(clean, other):
    mse = mse_of(clean, other)
    return 100.0 if mse == 0 else psnr_with(mse)

# %% role="mistake" name="255 for equal images" says="For equal images you return 255. They have no noise at all, so their PSNR is infinite: return float(\"inf\")."
def my_psnr(clean, other):
    mse = mse_of(clean, other)
    return 255.0 if mse == 0 else psnr_with(mse)

# %% role="mistake" name="one value for each row" says="You return one value for each row, because the mean was taken with axis=1. Leave axis out to get one mean of all pixels."
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2, axis=1)
    return float("inf") if (mse == 0).all() else 10 * np.log10(255**2 / np.maximum(mse, 1e-9))

# %% role="mistake" name="one value for each column" says="You return one value for each column, because the mean was taken with axis=0. Leave axis out to get one mean of all pixels."
def my_psnr(clean, other):
    mse = np.mean((clean.astype(float) - other) ** 2, axis=0)
    return float("inf") if (mse == 0).all() else 10 * np.log10(255**2 / np.maximum(mse, 1e-9))

# %% role="mistake" name="one value for each pixel" says="You return an array, one value for each pixel. Take the mean of all squared differences before the logarithm: the result is one number."
def my_psnr(clean, other):
    squared = (clean.astype(float) - other) ** 2
    return float("inf") if (squared == 0).all() else 10 * np.log10(255**2 / np.maximum(squared, 1e-9))
