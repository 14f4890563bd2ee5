# %% [markdown]
# # node-process

# %%
def gray_of(frame):
    return cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)

def weighted(frame, blue, green, red):
    return blue * frame[..., 0] + green * frame[..., 1] + red * frame[..., 2]

# %% role="mistake" name="decimal weights of red and blue exchanged" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY."
def process(frame):
    return {"gray": np.round(weighted(frame, 0.299, 0.587, 0.114)).astype(np.uint8)}

# %% role="mistake" name="decimal weights of red and blue exchanged, truncated" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY."
def process(frame):
    return {"gray": weighted(frame, 0.299, 0.587, 0.114).astype(np.uint8)}

# %% role="mistake" name="red and blue exchanged, without a dictionary" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY. And return a dictionary, {\"gray\": image}."
def process(frame):
    return cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY)

# %% role="mistake" name="the frame itself" says="Your value is the frame itself, with its three channels. Convert it first: one number per pixel, (height, width). Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame.copy()}

# %% role="mistake" name="the key Gray" says="Your image is right, but its key is \"Gray\" and not \"gray\", so it would go to a topic without subscribers. Keys are compared letter by letter: no capital letter."
def process(frame):
    return {"Gray": gray_of(frame)}

# %% role="mistake" name="the average, rounded" says="This is the average of the three channels. Luma is a weighted sum: green counts most. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": np.round(frame.mean(axis=2)).astype(np.uint8)}

# %% role="mistake" name="the average, as float" says="This is the average of the three channels. Luma is a weighted sum: green counts most. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame.mean(axis=2)}

# %% role="mistake" name="the average, added as uint8" says="This is the average of the three channels, and the sum was computed in uint8: above 255 it starts again at 0 (overflow). Luma is a weighted sum. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": (frame[..., 0] + frame[..., 1] + frame[..., 2]) // np.uint8(3)}

# %% role="mistake" name="decimal weights, rounded" says="Nearly all values are right; a few differ by one gray level. This is the effect of decimal weights (0.114, 0.587, 0.299): with cv2.cvtColor, all values are right."
def process(frame):
    return {"gray": np.round(weighted(frame, 0.114, 0.587, 0.299)).astype(np.uint8)}

# %% role="mistake" name="the largest channel" says="This is the largest channel of each pixel (the value V of HSV), not luma. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame.max(axis=-1)}

# %% role="mistake" name="divided by 255" says="The image is divided by 255. Return it as it is: uint8, 0 to 255."
def process(frame):
    return {"gray": gray_of(frame) / 255}

# %% role="mistake" name="the blue channel" says="You return the blue channel alone. Luma is a weighted sum of blue, green and red. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame[..., 0].copy()}

# %% role="mistake" name="the green channel" says="You return the green channel alone. Luma is a weighted sum of blue, green and red. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame[..., 1].copy()}

# %% role="mistake" name="the red channel" says="You return the red channel alone. Luma is a weighted sum of blue, green and red. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame[..., 2].copy()}

# %% role="mistake" name="a call that OpenCV refuses" says="OpenCV could not use these arguments. cv2.cvtColor takes an array and a conversion code: cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY). (cv2.imread reads a file, and frame is an array already.)"
def process(frame):
    return {"gray": cv2.cvtColor(frame)}
