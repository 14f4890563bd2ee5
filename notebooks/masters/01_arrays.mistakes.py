# %% [markdown]
# # arrays-crop

# %% role="mistake" name="two pairs of brackets" says="The second pair of brackets cuts the rows again, so the rows were cut twice. Write both slices in one pair, with a comma: image[top:bottom, left:right]."
def crop(image, top, bottom, left, right):
    return image[top:bottom][left:right]

# %% role="mistake" name="rows only" says="You cut the rows, but every column is kept. Add the second slice, left:right, after a comma."
def crop(image, top, bottom, left, right):
    return image[top:bottom]

# %% role="mistake" name="columns only" says="You cut the columns, but every row is kept. The first slice must be top:bottom."
def crop(image, top, bottom, left, right):
    return image[:, left:right]

# %% role="mistake" name="the rest is black" says="Your result has the full size of the image, and the rest is 0. Return only the part, with its smaller shape: image[top:bottom, left:right]."
def crop(image, top, bottom, left, right):
    result = np.zeros_like(image)
    result[top:bottom, left:right] = image[top:bottom, left:right]
    return result

# %% role="mistake" name="the numbers of the example" says="Your slices are fixed numbers, and they fit one example only. Use the parameters: top:bottom, left:right."
def crop(image, top, bottom, left, right):
    return image[1:4, 2:5]

# %% [markdown]
# # arrays-mirror

# %% role="mistake" name="last axis reversed" says="[..., ::-1] reverses the last axis, and in a colour image this axis holds the channels. The columns are the second axis: [:, ::-1]."
def mirror(image):
    return image[..., ::-1]

# %% role="mistake" name="an empty slice" says="Your result is empty: it has no column. In 0:-1:-1 the stop -1 means the last column. Leave start and stop out: ::-1."
def mirror(image):
    return image[:, 0:-1:-1]

# %% role="mistake" name="transposed" says="The axes are exchanged: rows became columns (this is called transposed). Keep the axes, and reverse the order of the columns: [:, ::-1]."
def mirror(image):
    return image.T

# %% [markdown]
# # arrays-red

# %% role="mistake" name="column 2" says="This is column 2 of the image: the second index is for columns. The channel is the third index: bgr[:, :, 2]."
def red_channel(bgr):
    return bgr[:, 2]

# %% role="mistake" name="mean of the channels" says="This is the mean (average) of the three channels. The task asks for the red one: bgr[..., 2]."
def red_channel(bgr):
    return bgr.mean(axis=2).astype(np.uint8)

# %% [markdown]
# # arrays-share

# %% role="mistake" name="counted" says="You counted the bright pixels. Percent is 100 times their share: the mean of the mask times 100."
def bright_percent(gray, level):
    return int((gray > level).sum())

# %% role="mistake" name="all that are not bright" says="These are the pixels that are not brighter than level: the opposite. Compare with gray > level."
def bright_percent(gray, level):
    return float((gray <= level).mean() * 100)

# %% role="mistake" name="divided by the rows" says="The number of bright pixels was divided by the number of rows only. Divide by the number of all pixels, gray.size (rows times columns)."
def bright_percent(gray, level):
    return float((gray > level).sum() / len(gray) * 100)

# %% role="mistake" name="the mask" says="This is the mask, an array with True or False for each pixel. Return one number: its mean times 100."
def bright_percent(gray, level):
    return gray > level

# %% role="mistake" name="one number for each column" says="axis=0 gives one number for each column. Leave the axis out: you need one number for the whole image."
def bright_percent(gray, level):
    return (gray > level).mean(axis=0) * 100

# %% [markdown]
# # arrays-paint

# %% role="mistake" name="only the selected pixels" says="result[mask] is only the selected pixels, in one row. Return the whole image: result."
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 255
    return result[mask]

# %% role="mistake" name="painted with 1" says="The pixels of the mask became 1, which is almost black. White is 255."
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 1
    return result

# %% role="mistake" name="added in uint8" says="The painted pixels are one gray level darker, not white: gray + 255 overflows in uint8. Set them with = instead: result[mask] = 255."
def paint_white(gray, mask):
    return gray + mask.astype(np.uint8) * np.uint8(255)

# %% role="mistake" name="255 added" says="255 was added to the painted pixels. They must become 255: painted[mask] = 255."
def paint_white(gray, mask):
    return gray + mask * 255

# %% role="mistake" name="the mask" says="This is the mask itself, with True and False. Return a copy of gray in which the pixels of the mask are 255."
def paint_white(gray, mask):
    return mask

# %% [markdown]
# # arrays-row-means

# %% role="mistake" name="an axis of length 1 is kept" says="Your result has the shape (rows, 1). One axis must remain: the shape is (rows,), so leave keepdims out."
def row_means(gray):
    return gray.mean(axis=1, keepdims=True)

# %% role="mistake" name="the median" says="This is the median of each row, the value in the middle. The task asks for the mean."
def row_means(gray):
    return np.median(gray, axis=1)

# %% role="mistake" name="the maximum" says="This is the largest gray level of each row (max). The task asks for the mean."
def row_means(gray):
    return gray.max(axis=1).astype(float)

# %% role="mistake" name="whole numbers" says="The decimals are cut off (// or an integer dtype does that). Divide with /, and keep the float result."
def row_means(gray):
    return (gray.sum(axis=1) // gray.shape[1]).astype(float)

# %% role="mistake" name="only the first row" says="This is the mean of the first row only. With axis=1 you get an array with one mean for each row."
def row_means(gray):
    return float(gray[0].mean())

# %% [markdown]
# # arrays-differences

# %% role="mistake" name="subtracted in uint8" says="You subtract in uint8, which has no negative numbers. Widen with astype(np.int16) before you subtract."
def differences(gray):
    return gray[:, 1:] - gray[:, :-1]

# %% role="mistake" name="rolled" says="Your result has one column too many. np.roll puts the first column behind the last one, which has no right neighbour. Use two slices."
def differences(gray):
    wide = gray.astype(np.int16)
    return np.roll(wide, -1, axis=1) - wide
