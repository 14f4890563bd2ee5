# %% name="Path instead of text" origin="walk" sentence="You return a Path, and the task asks for text: wrap it in str()." must_say=["\\bPath\\b", "\\bstr\\b"] kind="type"
def executable_of(install, package):
    from pathlib import Path

    return Path(install) / package / "lib" / package / package

# %% name="backslashes" origin="new" sentence="The task wants / between the parts, not a backslash." must_say=["backslash"] must_not_say=["lib is missing"] kind="value"
def executable_of(install, package):
    return install + "\\" + package + "\\lib\\" + package + "\\" + package

# %% name="text divided by text" origin="new" sentence="Texts cannot be joined with /, only a Path can: use an f-string, or Path(install) / package." must_say=["text|string|\\bstr\\b", "Path\\(|Path\\b", "joined with /|only a Path|divid|f-string|/"] kind="error"
def executable_of(install, package):
    return install / package / "lib" / package / package

# %% name="join called on the list" origin="new" sentence="join is a method of the separator, not of the list: write \"/\".join(parts)." must_say=["\\bjoin\\b", "separator|method|not of the list|\"/\"\\.join"] kind="error"
def executable_of(install, package):
    parts = [install, package, "lib", package, package]
    return parts.join("/")

# %% name="prefix of another cell" origin="new" sentence="prefix is a name of another cell and belongs to one package: build the path from install and package." must_say=["\\bprefix\\b", "install|package|argument|cell"] kind="other-cell"
def executable_of(install, package):
    return str(prefix / "lib" / package / package)

# %% name="print instead of return" origin="new" sentence="You print the path and return nothing: use return." must_say=["return", "print"] kind="no-return"
def executable_of(install, package):
    print(f"{install}/{package}/lib/{package}/{package}")

# %% name="return forgotten" origin="new" sentence="The path is stored in a name and lost: end with return path." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] must_not_say=["print"] kind="no-return"
def executable_of(install, package):
    path = f"{install}/{package}/lib/{package}/{package}"

# %% name="only the file's name" origin="new" sentence="You return the name of the file alone; the task asks for its whole path, beginning with install." must_say=["name", "alone|only", "path|install"] kind="value"
def executable_of(install, package):
    from pathlib import Path

    return (Path(install) / package / "lib" / package / package).name

# %% name="looks on the disk" origin="new" sentence="The folder need not exist on this machine, so a search on the disk finds nothing: put the path together from the two texts." must_say=["exist|search|disk|find|glob", "text|join|build|together|path"] kind="type"
def executable_of(install, package):
    from pathlib import Path

    found = sorted(Path(install).glob(f"{package}/lib/{package}/{package}"))
    return str(found[0]) if found else None

# %% name="absolute path" origin="new" sentence="resolve() puts the current folder before the path: leave install as it was given." must_say=["resolve|absolute|current folder|working (folder|directory)", "install|given|leave|as it|without"] kind="value"
def executable_of(install, package):
    from pathlib import Path

    return str((Path(install) / package / "lib" / package / package).resolve())

# %% name="quotes not closed" origin="new" sentence="Python cannot read this line: the text is opened with a quote and never closed." must_say=["quot|string|text", "syntax|closed|terminated|Python"] kind="syntax"
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}

# %% name="join of five arguments" origin="walk" sentence="join takes one list of the parts." must_say=["join", "list"] kind="error"
def executable_of(install, package):
    return "/".join(install, package, "lib", package, package)

# %% name="the workspace of the lesson typed" origin="new" sentence="You typed ros2_ws/install: use the argument install." must_say=["typed|ros2_ws", "argument"] kind="value"
def executable_of(install, package):
    return "ros2_ws/install/" + package + "/lib/" + package + "/" + package

# %% name="another folder typed" origin="new" sentence="install is an argument: its value differs from call to call." must_say=["argument", "folder|value"] kind="value"
def executable_of(install, package):
    return "/home/me/ros2_ws/install/" + package + "/lib/" + package + "/" + package
