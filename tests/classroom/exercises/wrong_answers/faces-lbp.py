# %% name="only the middle" sentence="Only the pixel [1, 1] gets a code; each pixel with eight neighbours needs one." must_say=["each|every|all|shape|one number"] kind="shape"
def lbp_codes(gray):
    answers = gray[0:3, 0:3] >= gray[1, 1]
    code = 1 * answers[0, 0] + 2 * answers[0, 1] + 4 * answers[0, 2] + 8 * answers[1, 2]
    code += 16 * answers[2, 2] + 32 * answers[2, 1] + 64 * answers[2, 0] + 128 * answers[1, 0]
    return np.array([[code]], np.uint8)

# %% name="straight neighbours" sentence="The diagonal neighbours count too." must_say=["diagonal"] kind="value"
def lbp_codes(gray):
    c = gray[1:-1, 1:-1]
    codes = 2 * (gray[:-2, 1:-1] >= c) + 8 * (gray[1:-1, 2:] >= c)
    codes = codes + 32 * (gray[2:, 1:-1] >= c) + 128 * (gray[1:-1, :-2] >= c)
    return codes.astype(np.uint8)
