# %% [markdown]
# # node-process

# %% role="mistake" name="the array without its dictionary" says="You return the image itself. The node also needs the name of its topic: return a dictionary, {\"gray\": image}."
def process(frame):
    return gray_of(frame)

# %% role="mistake" name="a tuple of name and image" says="You return a tuple with the name and the image. Return a dictionary: {\"gray\": image}, with curly brackets and a colon."
def process(frame):
    return "gray", gray_of(frame)

# %% role="mistake" name="a list with the dictionary" says="You return a list with the dictionary in it. Return the dictionary alone: {\"gray\": image}."
def process(frame):
    return [{"gray": gray_of(frame)}]

# %% role="mistake" name="the gray image as a list" says="The value under \"gray\" is a list of lists. It must be an array: leave out tolist()."
def process(frame):
    return {"gray": gray_of(frame).tolist()}

# %% role="mistake" name="red and blue exchanged" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY."
def process(frame):
    return {"gray": cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY)}

# %% role="mistake" name="decimal weights of red and blue exchanged" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY."
def process(frame):
    return {"gray": np.round(weighted(frame, 0.299, 0.587, 0.114)).astype(np.uint8)}

# %% role="mistake" name="decimal weights of red and blue exchanged, truncated" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY."
def process(frame):
    return {"gray": weighted(frame, 0.299, 0.587, 0.114).astype(np.uint8)}

# %% role="mistake" name="red and blue exchanged, without a dictionary" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY. And return a dictionary, {\"gray\": image}."
def process(frame):
    return cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY)

# %% role="mistake" name="gray with three channels" says="Your image is gray, but it has three equal channels. A gray image has one number per pixel: (height, width)."
def process(frame):
    return {"gray": cv2.cvtColor(gray_of(frame), cv2.COLOR_GRAY2BGR)}

# %% role="mistake" name="the frame itself" says="Your value is the frame itself, with its three channels. Convert it first: one number per pixel, (height, width). Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame.copy()}

# %% role="mistake" name="the key grey" says="Your image is right, but its key is \"grey\" and not \"gray\", so it would go to a topic without subscribers."
def process(frame):
    return {"grey": gray_of(frame)}

# %% role="mistake" name="the key Gray" says="Your image is right, but its key is \"Gray\" and not \"gray\", so it would go to a topic without subscribers. Keys are compared letter by letter: no capital letter."
def process(frame):
    return {"Gray": gray_of(frame)}

# %% role="mistake" name="the key image" says="Your image is right, but its key is \"image\" and not \"gray\", so it would go to a topic without subscribers."
def process(frame):
    return {"image": gray_of(frame)}

# %% role="mistake" name="the key mono8" says="Your image is right, but its key is \"mono8\" and not \"gray\", so it would go to a topic without subscribers."
def process(frame):
    return {"mono8": gray_of(frame)}

# %% role="mistake" name="the topic as the key" says="Your image is right, but its key is \"~/gray\" and not \"gray\", so it would go to a topic without subscribers. The node writes the ~/ itself."
def process(frame):
    return {"~/gray": gray_of(frame)}

# %% role="mistake" name="the frame as a second key" says="The image under \"gray\" is right, but there is another key, \"frame\". The task asks for one key only, \"gray\"."
def process(frame):
    return {"frame": frame.copy(), "gray": gray_of(frame)}

# %% role="mistake" name="the average" says="This is the average of the three channels. Luma is a weighted sum: green counts most. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame.mean(axis=2).astype(np.uint8)}

# %% role="mistake" name="the average, rounded" says="This is the average of the three channels. Luma is a weighted sum: green counts most. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": np.round(frame.mean(axis=2)).astype(np.uint8)}

# %% role="mistake" name="the average, as float" says="This is the average of the three channels. Luma is a weighted sum: green counts most. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame.mean(axis=2)}

# %% role="mistake" name="the average, added as uint8" says="This is the average of the three channels, and the sum was computed in uint8: above 255 it starts again at 0 (overflow). Luma is a weighted sum. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": (frame[..., 0] + frame[..., 1] + frame[..., 2]) // np.uint8(3)}

# %% role="mistake" name="decimal weights, truncated" says="The values are truncated, not rounded: the fraction is dropped. Round before you narrow, or let cv2.cvtColor do it."
def process(frame):
    return {"gray": weighted(frame, 0.114, 0.587, 0.299).astype(np.uint8)}

# %% role="mistake" name="integer weights, truncated" says="The values are truncated, not rounded: the fraction is dropped. Round before you narrow, or let cv2.cvtColor do it."
def process(frame):
    return {"gray": (weighted(frame.astype(np.uint32), 3735, 19235, 9798) >> 15).astype(np.uint8)}

# %% role="mistake" name="decimal weights, rounded" says="Nearly all values are right; a few differ by one gray level. This is the effect of decimal weights (0.114, 0.587, 0.299): with cv2.cvtColor, all values are right."
def process(frame):
    return {"gray": np.round(weighted(frame, 0.114, 0.587, 0.299)).astype(np.uint8)}

# %% role="mistake" name="decimal weights, as float" says="The values still have fractions, and the dtype is float. The image must be uint8. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": weighted(frame, 0.114, 0.587, 0.299)}

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

# %% role="mistake" name="upside down" says="The gray image is right, but upside down: [::-1] reverses the rows. Here, return the gray image as it is; section 7 is for such changes."
def process(frame):
    return {"gray": gray_of(frame)[::-1].copy()}

# %% role="mistake" name="left and right exchanged" says="The gray image is right, but flipped from left to right. Here, return the gray image as it is; section 7 is for such changes."
def process(frame):
    return {"gray": gray_of(frame)[:, ::-1].copy()}

# %% role="mistake" name="the negative" says="The gray image is inverted (255 - gray). Here, return the gray image as it is; section 7 is for such changes."
def process(frame):
    return {"gray": 255 - gray_of(frame)}

# %% role="mistake" name="a call that OpenCV refuses" says="OpenCV could not use these arguments. cv2.cvtColor takes an array and a conversion code: cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY). (cv2.imread reads a file, and frame is an array already.)"
def process(frame):
    return {"gray": cv2.cvtColor(frame)}
