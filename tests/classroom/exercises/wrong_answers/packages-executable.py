# %% name="stops at the folder" origin="walk" sentence="Your path ends with the folder lib/PACKAGE; the executable is a file in it, with the package's name once more at the end." must_say=["ends? with the folder|ends at|too early|stops|last part|is a folder|a directory", "once more|again|twice|at the end|executable is|file in it|missing"] kind="value"
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}"

# %% name="script with .py" origin="walk" sentence="The executable has no ending: leave .py out." must_say=["\\.py|ending|suffix|extension"] kind="value"
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}.py"

# %% name="Path instead of text" origin="walk" sentence="You return a Path, and the task asks for text: wrap it in str()." must_say=["\\bPath\\b", "\\bstr\\b"] kind="type"
def executable_of(install, package):
    from pathlib import Path

    return Path(install) / package / "lib" / package / package

# %% name="prefix without the package" origin="new" sentence="Each package has a folder of its own in install: after install comes the package's name, then lib." must_say=["own|after install|each package|between install", "package", "lib|folder|prefix|install", "own|after install|between|missing|each package"] must_not_say=["\\.py"] kind="value"
def executable_of(install, package):
    return f"{install}/lib/{package}/{package}"

# %% name="bin instead of lib" origin="new" sentence="ros2 run looks in lib, not in bin." must_say=["\\bbin\\b", "\\blib\\b"] must_not_say=["\\.py"] kind="value"
def executable_of(install, package):
    return f"{install}/{package}/bin/{package}"

# %% name="share instead of lib" origin="new" sentence="share holds package.xml and other data; the executables are in lib." must_say=["\\bshare\\b", "\\blib\\b"] kind="value"
def executable_of(install, package):
    return f"{install}/{package}/share/{package}/{package}"

# %% name="without lib" origin="new" sentence="The folder lib is missing between the package's folder and its executables." must_say=["\\blib\\b", "missing|left out|forg|add|between"] kind="value"
def executable_of(install, package):
    return f"{install}/{package}/{package}/{package}"

# %% name="hard-coded package" origin="new" sentence="You typed image_gray_processor in: use the argument package, so that the function works for other packages too." must_say=["image_gray_processor|typed|fixed|hard|other packages", "package|argument"] kind="value"
def executable_of(install, package):
    return f"{install}/image_gray_processor/lib/image_gray_processor/image_gray_processor"

# %% name="names in quotes" origin="new" sentence="Without the f before the quotes the names in braces are not replaced: write f\"...\"." must_say=["\\bf before|f-string|f\"", "braces|replaced|before the quote|\\{"] kind="value"
def executable_of(install, package):
    return "{install}/{package}/lib/{package}/{package}"

# %% name="words instead of values" origin="new" sentence="Inside the quotes stand the words install and package themselves: use the values of the arguments, with an f-string or +." must_say=["quot|words|literal", "argument|value|f-string|variable", "themselves|words|literal|values? of"] kind="value"
def executable_of(install, package):
    return "install/package/lib/package/package"

# %% name="slashes forgotten" origin="new" sentence="+ joins the texts without anything between them: put \"/\" between the parts." must_say=["/|slash", "between|without|join", "without anything|nothing between|missing|put|joins the"] must_not_say=["\\.py", "bin"] kind="value"
def executable_of(install, package):
    return install + package + "lib" + package + package

# %% name="backslashes" origin="new" sentence="The task wants / between the parts, not a backslash." must_say=["backslash"] must_not_say=["lib is missing"] kind="value"
def executable_of(install, package):
    return install + "\\" + package + "\\lib\\" + package + "\\" + package

# %% name="slash at the end" origin="new" sentence="The path of a file does not end with /: leave the last slash out." must_say=["last slash|end with /|trailing|at the end|ends with (a )?(/|slash)", "slash|/"] kind="value"
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}/"

# %% name="text divided by text" origin="new" sentence="Texts cannot be joined with /, only a Path can: use an f-string, or Path(install) / package." must_say=["text|string|\\bstr\\b", "Path\\(|Path\\b", "joined with /|only a Path|divid|f-string|/"] kind="error"
def executable_of(install, package):
    return install / package / "lib" / package / package

# %% name="parts as a list" origin="new" sentence="You return a list of the parts: join them to one text with \"/\".join(parts)." must_say=["\\blist\\b", "join|one text|string|text", "return|list of"] kind="type"
def executable_of(install, package):
    return [install, package, "lib", package, package]

# %% name="join called on the list" origin="new" sentence="join is a method of the separator, not of the list: write \"/\".join(parts)." must_say=["\\bjoin\\b", "separator|method|not of the list|\"/\"\\.join"] kind="error"
def executable_of(install, package):
    parts = [install, package, "lib", package, package]
    return parts.join("/")

# %% name="arguments exchanged" origin="new" sentence="You begin with package and put install behind it; the path begins with install." must_say=["install", "begin|start|first|order|swap|exchang", "package"] kind="value"
def executable_of(install, package):
    return f"{package}/{install}/lib/{install}/{install}"

# %% name="prefix of another cell" origin="new" sentence="prefix is a name of another cell and belongs to one package: build the path from install and package." must_say=["\\bprefix\\b", "install|package|argument|cell"] kind="other-cell"
def executable_of(install, package):
    return str(prefix / "lib" / package / package)

# %% name="print instead of return" origin="new" sentence="You print the path and return nothing: use return." must_say=["return", "print"] kind="no-return"
def executable_of(install, package):
    print(f"{install}/{package}/lib/{package}/{package}")

# %% name="return forgotten" origin="new" sentence="The path is stored in a name and lost: end with return path." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] must_not_say=["print"] kind="no-return"
def executable_of(install, package):
    path = f"{install}/{package}/lib/{package}/{package}"

# %% name="word install twice" origin="new" sentence="The argument install is the folder install already: do not add /install once more." must_say=["install", "already|twice|once more|again", "folder|/install|add"] kind="value"
def executable_of(install, package):
    return f"{install}/install/{package}/lib/{package}/{package}"

# %% name="executable with another name" origin="new" sentence="The executable has the same name as the package: do not add _node." must_say=["same name|_node|name of the package"] kind="value"
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}_node"

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

# %% name="workspace name in front" origin="walk" sentence="The path begins with the word install, and the argument install is not used: write {install} in the f-string." must_say=["argument|\\{install\\}"] must_not_say=["\\blib\\b .*missing"] kind="value"
def executable_of(install, package):
    return f"install/{package}/lib/{package}/{package}"

# %% name="join of five arguments" origin="walk" sentence="join takes one list of the parts." must_say=["join", "list"] kind="error"
def executable_of(install, package):
    return "/".join(install, package, "lib", package, package)

# %% name="lib twice" origin="walk" sentence="lib stands once in the path, after the name of the package." must_say=["\\blib\\b", "once|twice"] kind="value"
def executable_of(install, package):
    return f"{install}/lib/{package}/lib/{package}"

# %% name="the workspace of the lesson typed" origin="new" sentence="You typed ros2_ws/install: use the argument install." must_say=["typed|ros2_ws", "argument"] kind="value"
def executable_of(install, package):
    return "ros2_ws/install/" + package + "/lib/" + package + "/" + package

# %% name="another folder typed" origin="new" sentence="install is an argument: its value differs from call to call." must_say=["argument", "folder|value"] kind="value"
def executable_of(install, package):
    return "/home/me/ros2_ws/install/" + package + "/lib/" + package + "/" + package
