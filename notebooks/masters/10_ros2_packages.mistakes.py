# %% [markdown]
# # packages-executable

# %% role="mistake" name="stops at the folder" says="Your path stops at the folder lib/<package>. The executable is a file in it: add the name of the package once more at the end."
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}"

# %% role="mistake" name="stops at lib" says="Your path stops at the folder lib. The executable is in lib/<package>: add the name of the package twice at the end."
def executable_of(install, package):
    return f"{install}/{package}/lib"

# %% role="mistake" name="bin instead of lib" says="ROS keeps the executables of a package in lib/<package>, not in bin. See setup.cfg."
def executable_of(install, package):
    return f"{install}/{package}/bin/{package}"

# %% role="mistake" name="bin instead of lib, with its folder" says="ROS keeps the executables of a package in lib/<package>, not in bin. See setup.cfg."
def executable_of(install, package):
    return f"{install}/{package}/bin/{package}/{package}"

# %% role="mistake" name="src instead of lib" says="src is the folder of the source code in a workspace. The installed executables are in lib."
def executable_of(install, package):
    return f"{install}/{package}/src/{package}/{package}"

# %% role="mistake" name="without lib" says="The folder lib is missing between the folder of the package and its executables."
def executable_of(install, package):
    return f"{install}/{package}/{package}/{package}"

# %% role="mistake" name="without lib, one name missing" says="The folder lib is missing, and the name of the package occurs once more: the parts are install, package, lib, package, executable."
def executable_of(install, package):
    return f"{install}/{package}/{package}"

# %% role="mistake" name="without the folder of the package" says="Each package has a folder of its own in install: after install comes the name of the package, then lib."
def executable_of(install, package):
    return f"{install}/lib/{package}/{package}"

# %% role="mistake" name="lib twice" says="lib occurs twice in your path. After install comes the name of the package; lib follows, once."
def executable_of(install, package):
    return f"{install}/lib/{package}/lib/{package}"

# %% role="mistake" name="a script with .py" says="The installed executable has no ending: leave out .py."
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}.py"

# %% role="mistake" name="another name for the executable" says="The executable has the same name as the package: do not add _node."
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}_node"

# %% role="mistake" name="a fixed package: the edge node" says="You typed image_edge_detection. Use the argument package, so that the function works for other packages too."
def executable_of(install, package):
    return f"{install}/image_edge_detection/lib/image_edge_detection/image_edge_detection"

# %% role="mistake" name="no f before the quotes" says="The names in braces are not replaced, because the f before the quotes is missing: f\"...\"."
def executable_of(install, package):
    return "{install}/{package}/lib/{package}/{package}"

# %% role="mistake" name="words instead of values" says="Inside the quotes, the words install and package stand for themselves. Use the values of the arguments: an f-string, f\"{install}/{package}/...\"."
def executable_of(install, package):
    return "install/package/lib/package/package"

# %% role="mistake" name="no slashes" says="The parts are joined with nothing between them. Put \"/\" between each two parts."
def executable_of(install, package):
    return install + package + "lib" + package + package

# %% role="mistake" name="spaces instead of slashes" says="The parts are joined with spaces. Put / between the parts."
def executable_of(install, package):
    return " ".join([install, package, "lib", package, package])

# %% role="mistake" name="backslashes" says="Your path has a backslash between the parts. ROS 2 on Linux uses /."
def executable_of(install, package):
    return "\\".join([install, package, "lib", package, package])

# %% role="mistake" name="a slash at the end" says="The path of a file does not end with /: leave out the last slash."
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}/"

# %% role="mistake" name="a slash before install" says="You put a / before install. The path begins with install, exactly as it is given."
def executable_of(install, package):
    return f"/{install}/{package}/lib/{package}/{package}"

# %% role="mistake" name="a list of the parts" says="You return a list of the parts. Join them to one string: \"/\".join(parts)."
def executable_of(install, package):
    return [install, package, "lib", package, package]

# %% role="mistake" name="a tuple of the parts" says="You return a tuple of the parts. Join them to one string: \"/\".join(parts)."
def executable_of(install, package):
    return install, package, "lib", package, package

# %% role="mistake" name="install twice" says="The argument install is already the folder install: do not add /install once more."
def executable_of(install, package):
    return f"{install}/install/{package}/lib/{package}/{package}"

# %% role="mistake" name="the name of the file only" says="You return only the name of the file. The task asks for its whole path, which begins with install."
def executable_of(install, package):
    return package

# %% role="mistake" name="the word install" says="Your path begins with the word install. It must begin with the value of the argument install: in an f-string write {install}, with braces."
def executable_of(install, package):
    return f"install/{package}/lib/{package}/{package}"

# %% role="mistake" name="the path without install" says="Your path does not begin with install: put install and a / before it."
def executable_of(install, package):
    return f"{package}/lib/{package}/{package}"

# %% role="mistake" name="install dropped by a slash" says="Your path begins with /lib: install and package are lost. (In Path and os.path.join, a part that begins with / drops all parts before it.)"
def executable_of(install, package):
    return f"/lib/{package}/{package}"

# %% role="mistake" name="two slashes" says="There are two slashes between two parts of your path. One is enough."
def executable_of(install, package):
    return f"{install}/{package}//lib/{package}/{package}"

# %% role="mistake" name="a dot before install" says="You put ./ before install. The path begins with install, exactly as it is given."
def executable_of(install, package):
    return f"./{install}/{package}/lib/{package}/{package}"

# %% role="mistake" name="a list converted by str" says="You convert a list to a string with str(), and its brackets and commas are in the result. Join the parts: \"/\".join(parts)."
def executable_of(install, package):
    return str([install, package, "lib", package, package])

# %% role="mistake" name="the last slash is missing" says="The last slash is missing: between the folder lib/<package> and the executable there is a / too."
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}{package}"

# %% role="mistake" name="the command" says="This is the command that starts the node. The task asks for the path of the file that the command starts."
def executable_of(install, package):
    return f"ros2 run {package} {package}"
