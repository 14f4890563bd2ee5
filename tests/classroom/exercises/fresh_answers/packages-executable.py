# %% name="backslashes" origin="fresh" sentence="The parts must be joined with /, a slash; a backslash is only for Windows." must_say=["slash|\"/\"|with /| / "] kind="value"
def executable_of(install, package):
    return install + "\\" + package + "\\lib\\" + package + "\\" + package

# %% name="a Path, not a string" origin="fresh" sentence="You return a Path: the task asks for a string, write str(path)." must_say=["str|string|text"] kind="type"
def executable_of(install, package):
    path = Path(install) / package / "lib" / package / package
    return path

# %% name="share instead of lib" origin="fresh" sentence="share holds the data files; the executable is in lib." must_say=["lib|share"] kind="value"
def executable_of(install, package):
    return install + "/" + package + "/share/" + package + "/" + package

# %% name="the example's package" origin="fresh" sentence="You write the name of the example; use the argument package." must_say=["package|argument|parameter|given|example"] must_not_say=["lib folder"] kind="value"
def executable_of(install, package):
    return install + "/image_gray_processor/lib/image_gray_processor/image_gray_processor"

# %% name="slashes forgotten" origin="fresh" sentence="The slashes between the parts are missing." must_say=["slash|\"/\"|with /| / "] kind="value"
def executable_of(install, package):
    return install + package + "lib" + package + package
