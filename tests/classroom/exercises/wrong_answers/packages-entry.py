# %% name="quotes around the line" sentence="The line stands in quotes inside the text: return the line alone." must_say=["quote|\"|'"] kind="value"
def entry_point(executable, package, file, function):
    return f'"{executable} = {package}.{file}:{function}"'

# %% name="executable for file" sentence="The file has the name that file gives." must_say=["\\bfile\\b"] kind="value"
def entry_point(executable, package, file, function):
    return f"{executable} = {package}.{executable}:{function}"
