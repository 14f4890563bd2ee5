# %% name="bgr[0] for blue" sentence="bgr[0] is the first row of the image, not the blue channel: the channels are the last axis, so write bgr[..., 0]." must_say=["bgr\\[0\\]|first row|is (the|a) row|rows?,", "last|\\.\\.\\.|\\[:, ?:|channel|axis"] kind="shape"
def luma(bgr):
    b, g, r = bgr[0].astype(np.uint32), bgr[1].astype(np.uint32), bgr[2].astype(np.uint32)
    return ((b * 3735 + g * 19235 + r * 9798 + 2**14) >> 15).astype(np.uint8)
