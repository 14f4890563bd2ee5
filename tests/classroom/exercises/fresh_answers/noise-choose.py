# %% name="smallest PSNR" origin="fresh" sentence="You keep the lowest PSNR; a higher PSNR means less noise." must_say=["high|large|greatest|max|lowest|small"] must_not_say=["noisy and clean|apply"] kind="value"
def best_filter(clean, noisy, filters):
    from imgproc_course.imaging import psnr
    best_name = None
    best_value = 10000
    for name in filters:
        value = psnr(clean, filters[name](noisy))
        if value < best_value:
            best_value = value
            best_name = name
    return best_name

# %% name="filters the clean image" origin="fresh" sentence="You apply the filter to clean; apply it to noisy, and compare with clean." must_say=["noisy|clean"] must_not_say=["highest|lowest"] kind="value"
def best_filter(clean, noisy, filters):
    from imgproc_course.imaging import psnr
    best_name = ""
    best_value = 0
    for name, function in filters.items():
        value = psnr(clean, function(clean))
        if value > best_value:
            best_value = value
            best_name = name
    return best_name

# %% name="returns the value" origin="fresh" sentence="You return the PSNR; the task asks for the name of the filter." must_say=["name|string|text"] kind="type"
def best_filter(clean, noisy, filters):
    from imgproc_course.imaging import psnr
    best = 0
    for name in filters:
        value = psnr(clean, filters[name](noisy))
        if value > best:
            best = value
    return best

# %% name="returns in the loop" origin="fresh" sentence="return stands inside the loop, so only the first filter is tried." must_say=["return|first|loop|every|all"] kind="value"
def best_filter(clean, noisy, filters):
    from imgproc_course.imaging import psnr
    best_value = 0
    for name, function in filters.items():
        value = psnr(clean, function(noisy))
        if value > best_value:
            best_value = value
            best_name = name
        return best_name

# %% name="never updates the best" origin="fresh" sentence="You never store the new best value, so every later filter replaces the name: the last filter is returned." must_say=["store|update|last|best|keep|remember|assign|high"] kind="value"
def best_filter(clean, noisy, filters):
    from imgproc_course.imaging import psnr
    best_name = ""
    best_value = 0
    for name, function in filters.items():
        value = psnr(clean, function(noisy))
        if value > best_value:
            best_name = name
    return best_name
