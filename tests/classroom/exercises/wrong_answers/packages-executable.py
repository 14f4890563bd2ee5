# %% name="Path instead of text" sentence="You return a Path, and the task asks for text: wrap it in str()." must_say=["\\bPath\\b", "\\bstr\\b"] kind="type"
def executable_of(install, package):
    from pathlib import Path

    return Path(install) / package / "lib" / package / package

# %% name="another folder typed" sentence="install is an argument: its value differs from call to call." must_say=["argument", "folder|value"] kind="value"
def executable_of(install, package):
    return "/home/me/ros2_ws/install/" + package + "/lib/" + package + "/" + package

# %% name="prefix of another cell" sentence="prefix is a name of another cell and belongs to one package: build the path from install and package." must_say=["\\bprefix\\b", "install|package|argument|cell"] kind="other-cell"
def executable_of(install, package):
    return str(prefix / "lib" / package / package)

# %% name="print instead of return" sentence="You print the path and return nothing: use return." must_say=["return", "print"] kind="no-return"
def executable_of(install, package):
    print(f"{install}/{package}/lib/{package}/{package}")
