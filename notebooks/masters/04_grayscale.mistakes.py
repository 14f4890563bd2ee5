# %% [markdown]
# # grayscale-luma

# %%
def luma_of(bgr, weights=(3735, 19235, 9798), half=2**14, dtype=np.uint32):
    wide = bgr.astype(dtype)
    b, g, r = (wide[..., channel] * dtype(weight) for channel, weight in enumerate(weights))
    return ((b + g + r + dtype(half)) >> dtype(15)).astype(np.uint8)

def weighted(bgr, blue, green, red):
    return blue * bgr[..., 0] + green * bgr[..., 1] + red * bgr[..., 2]

# %% role="mistake" name="the plain average, added as uint8" says="This is the plain average, and the sum was computed in uint8: above 255 it starts again at 0 (overflow). Luma is a weighted sum: widen first, then use the weights of section 4."
def luma(bgr):
    b, g, r = bgr[..., 0], bgr[..., 1], bgr[..., 2]
    return (b + g + r) // np.uint8(3)

# %% role="mistake" name="the plain average" says="This is the plain average of the three channels. Luma is a weighted sum: green counts most, blue least."
def luma(bgr):
    return (bgr.astype(np.uint32).sum(axis=-1) // 3).astype(np.uint8)

# %% role="mistake" name="the plain average, rounded" says="This is the plain average of the three channels. Luma is a weighted sum: green counts most, blue least."
def luma(bgr):
    return np.round(bgr.mean(axis=-1)).astype(np.uint8)

# %% role="mistake" name="the plain average, as float" says="This is the plain average of the three channels. Luma is a weighted sum: green counts most, blue least. At the end, round and narrow to uint8."
def luma(bgr):
    return bgr.mean(axis=-1)

# %% role="mistake" name="uint16 overflows, and no rounding" says="uint16 ends at 65535, and a product such as 255 * 19235 is larger: it overflows. Widen with astype(np.uint32) instead."
def luma(bgr):
    return luma_of(bgr, half=0, dtype=np.uint16)

# %% role="mistake" name="uint16 overflows in the products" says="uint16 ends at 65535, and a product such as 255 * 19235 is larger: it overflows. Widen with astype(np.uint32) instead."
def luma(bgr):
    total = (bgr * np.array([3735, 19235, 9798], np.uint16)).sum(axis=-1)
    return ((total + np.uint64(2**14)) >> np.uint64(15)).astype(np.uint8)

# %% role="mistake" name="int16 overflows" says="int16 ends at 32767, and a product such as 255 * 19235 is larger: it overflows. Widen with astype(np.uint32) instead."
def luma(bgr):
    return luma_of(bgr, dtype=np.int16)

# %% role="mistake" name="weights in per cent, and uint8 overflows" says="The sum is computed in uint8: above 255 it starts again at 0 (overflow). Widen first with astype(np.uint32), and use the weights of section 4."
def luma(bgr):
    return weighted(bgr, np.uint8(11), np.uint8(59), np.uint8(30)) // np.uint8(100)

# %% role="mistake" name="the first columns instead of the channels" says="bgr[:, 0] is the first column of the image, not the blue channel. The channels are on the last axis: write bgr[..., 0]."
def luma(bgr):
    return luma_of(np.stack([bgr[:, 0], bgr[:, 1], bgr[:, 2]], axis=-1))

# %% role="mistake" name="decimal weights, rounded" says="Nearly all values are right; a few differ by one gray level. This is the effect of decimal weights (0.114, 0.587, 0.299): use the integer weights 3735, 19235 and 9798 of section 4."
def luma(bgr):
    return np.round(weighted(bgr, 0.114, 0.587, 0.299)).astype(np.uint8)

# %% role="mistake" name="decimal weights, one half added" says="Nearly all values are right; a few differ by one gray level. This is the effect of decimal weights (0.114, 0.587, 0.299): use the integer weights 3735, 19235 and 9798 of section 4."
def luma(bgr):
    return (weighted(bgr, 0.114, 0.587, 0.299) + 0.5).astype(np.uint8)

# %% role="mistake" name="each product narrowed" says="The three products are narrowed to uint8 one by one, and each loses its fraction. Add them first; then round, and narrow last."
def luma(bgr):
    b, g, r = bgr[..., 0], bgr[..., 1], bgr[..., 2]
    return (0.114 * b).astype(np.uint8) + (0.587 * g).astype(np.uint8) + (0.299 * r).astype(np.uint8)

# %% role="mistake" name="truncated instead of rounded" says="The values are truncated, not rounded: the fraction is dropped. Add one half before you narrow (with integers: add 2**14 before >> 15)."
def luma(bgr):
    return luma_of(bgr, half=0)

# %% role="mistake" name="halves to the even number" says="A half is not rounded up everywhere. np.round, np.rint and round() take it to the even number: 116.5 becomes 116, and OpenCV gives 117. Add one half and drop the fraction (with integers: add 2**14 before >> 15)."
def luma(bgr):
    return np.rint(weighted(bgr.astype(np.uint32), 3735, 19235, 9798) / 2**15).astype(np.uint8)

# %% role="mistake" name="one added instead of one half" says="You add 2**15 before >> 15, which makes every truncated value larger by 1. Half of 32768 is 2**14."
def luma(bgr):
    return luma_of(bgr, half=2**15)

# %% role="mistake" name="the weights of red and blue are swapped" says="Blue got the weight of red, as if the channels were red, green, blue. In a frame they are blue, green, red: the weights are 3735, 19235, 9798 in this order."
def luma(bgr):
    return luma_of(bgr, (9798, 19235, 3735))

# %% role="mistake" name="swapped and truncated" says="Blue got the weight of red, as if the channels were red, green, blue. In a frame they are blue, green, red: the weights are 3735, 19235, 9798 in this order. Also round: add 2**14 before >> 15."
def luma(bgr):
    return luma_of(bgr, (9798, 19235, 3735), half=0)

# %% role="mistake" name="swapped decimal weights, rounded" says="Blue got the weight of red, as if the channels were red, green, blue. In a frame they are blue, green, red: the weights are 3735, 19235, 9798 in this order."
def luma(bgr):
    return np.round(weighted(bgr, 0.299, 0.587, 0.114)).astype(np.uint8)

# %% role="mistake" name="swapped decimal weights, truncated" says="Blue got the weight of red, as if the channels were red, green, blue. In a frame they are blue, green, red: the weights are 3735, 19235, 9798 in this order. Also round: add 2**14 before >> 15."
def luma(bgr):
    return weighted(bgr, 0.299, 0.587, 0.114).astype(np.uint8)

# %% role="mistake" name="the weights of green and red are swapped" says="Green and red got each other's weight. The channels are blue, green, red: the weights are 3735, 19235, 9798 in this order."
def luma(bgr):
    return luma_of(bgr, (3735, 9798, 19235))

# %% role="mistake" name="no blue in the sum" says="The blue channel is missing in your sum: add blue * 3735."
def luma(bgr):
    return luma_of(bgr, (0, 19235, 9798))

# %% role="mistake" name="no green in the sum" says="The green channel is missing in your sum: add green * 19235."
def luma(bgr):
    return luma_of(bgr, (3735, 0, 9798))

# %% role="mistake" name="no red in the sum" says="The red channel is missing in your sum: add red * 9798."
def luma(bgr):
    return luma_of(bgr, (3735, 19235, 0))

# %% role="mistake" name="divided by 2**16" says="The values are half as large as they should be: divide by 2**15 (shift by 15), not by 2**16."
def luma(bgr):
    return ((weighted(bgr.astype(np.uint32), 3735, 19235, 9798) + 2**14) >> 16).astype(np.uint8)

# %% role="mistake" name="every value is 0" says="Every value is 0. If you compute with the uint8 values themselves, the sum overflows, and a shift leaves nothing of it: widen first with astype(np.uint32). If you narrow to uint8 before the shift, shift first and narrow last. If you write >> 15 + 2**14, put the sum in parentheses: + is computed before >>, so the shift is too far."
def luma(bgr):
    return np.zeros(bgr.shape[:2], np.uint8)

# %% role="mistake" name="the largest channel" says="This is the largest channel of each pixel, not luma. Luma is a weighted sum of the three channels."
def luma(bgr):
    return bgr.max(axis=-1)

# %% role="mistake" name="lightness" says="This is the lightness: the mean of the largest and the smallest channel. Luma is a weighted sum of the three channels."
def luma(bgr):
    wide = bgr.astype(np.uint16)
    return ((wide.max(axis=-1) + wide.min(axis=-1)) // 2).astype(np.uint8)

# %% role="mistake" name="weights of BT.709, rounded" says="These are the weights of another standard, BT.709 (0.2126, 0.7152, 0.0722). This lesson uses BT.601: the integer weights 3735, 19235 and 9798."
def luma(bgr):
    return np.round(weighted(bgr, 0.0722, 0.7152, 0.2126)).astype(np.uint8)

# %% role="mistake" name="weights of BT.709, truncated" says="These are the weights of another standard, BT.709 (0.2126, 0.7152, 0.0722). This lesson uses BT.601: the integer weights 3735, 19235 and 9798. Also round, do not truncate."
def luma(bgr):
    return weighted(bgr, 0.0722, 0.7152, 0.2126).astype(np.uint8)

# %% role="mistake" name="the blue channel" says="You return the blue channel alone. Luma is a weighted sum of blue, green and red."
def luma(bgr):
    return bgr[..., 0].copy()

# %% role="mistake" name="the green channel" says="You return the green channel alone. Luma is a weighted sum of blue, green and red."
def luma(bgr):
    return bgr[..., 1].copy()

# %% role="mistake" name="the red channel" says="You return the red channel alone. Luma is a weighted sum of blue, green and red."
def luma(bgr):
    return bgr[..., 2].copy()
