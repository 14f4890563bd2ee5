# %% [markdown]
# # tour-binarize

# %% role="mistake" name="always 128" says="128 is fixed in your comparison. Compare with the parameter level."
def binarize(gray, level):
    return np.where(gray > 128, 255, 0).astype(np.uint8)

# %% role="mistake" name="all white" says="Every pixel became 255. If you change a copy twice, the second mask also selects the pixels that became 0 before: make both masks from gray first, or use np.where."
def binarize(gray, level):
    return np.full_like(gray, 255)

# %% role="mistake" name="positions" says="np.where with a condition alone gives positions (indices). Give it the two values too: np.where(gray > level, 255, 0)."
def binarize(gray, level):
    return np.where(gray > level)

# %% [markdown]
# # tour-name

# %% role="mistake" name="gray taken for binary" says="A gray image has up to 256 values, a binary image has two. Count the different values with np.unique."
def name_operation(before, after):
    operation = solution(before, after)
    return "binarization" if operation == "grayscale" else operation

# %% role="mistake" name="areas taken for lines" says="Not every image of two values is an edge image: binarization gives areas. Look at the share of white pixels, (after == 255).mean(). It is a number between 0 and 1: compare it with 0.2, not with 20."
def name_operation(before, after):
    operation = solution(before, after)
    return "edges" if operation == "binarization" else operation

# %% role="mistake" name="lines taken for areas" says="Not every image of two values is a binary image: edges have only 0 and 255, too. Edges are lines, so the share of white pixels is small. The share is the mean of the mask, (after == 255).mean(). The number of white pixels (sum) is not the share, and after.mean() is the mean gray level, from 0 to 255."
def name_operation(before, after):
    operation = solution(before, after)
    return "binarization" if operation == "edges" else operation

# %% role="mistake" name="three channels not recognised" says="The colour image was not recognised by its three dimensions. Ask first whether after.ndim, the number of dimensions, is 3. (after.shape is a tuple such as (45, 60, 3): it never equals the number 3, and other images have another size than the lesson's frame.)"
def name_operation(before, after):
    operation = solution(before, after)
    return "grayscale" if operation == "noise removal" else operation

# %% role="mistake" name="before and after expected to be equal" says="Noise removal was recognised only where before and after are equal. But noise removal changes pixels. What stays is the shape, with three channels: look at after.ndim."
def name_operation(before, after):
    if np.array_equal(before, after):
        return "noise removal"
    operation = solution(before, after)
    return "grayscale" if operation == "noise removal" else operation

# %% role="mistake" name="two values taken for gray" says="An image with only two different values was named \"grayscale\". Count the different values: np.unique(after).size."
def name_operation(before, after):
    return "noise removal" if after.ndim == 3 else "grayscale"

# %% role="mistake" name="a later name replaces an earlier one" says="All images with few white pixels are named \"edges\", the gray and the colour image, too. If your ifs stand one after the other, a later one replaces the name of an earlier one: use elif, or return the name at once."
def name_operation(before, after):
    return "edges" if (after == 255).mean() < 0.2 else solution(before, after)

# %% role="mistake" name="limit for lines too low" says="An edge image with many lines was named \"binarization\". In an edge image, up to a fifth of the pixels may be white: compare the share with 0.2."
def name_operation(before, after):
    operation = solution(before, after)
    return "binarization" if operation == "edges" and (after == 255).mean() > 0.1 else operation

# %% role="mistake" name="limit for areas too high" says="A binary image with more black than white was named \"edges\". In a binary image of this exercise only a quarter of the pixels may be white: compare the share with 0.2."
def name_operation(before, after):
    operation = solution(before, after)
    return "edges" if operation == "binarization" and (after == 255).mean() < 0.45 else operation
