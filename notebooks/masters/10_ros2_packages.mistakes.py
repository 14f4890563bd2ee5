# %% [markdown]
# # packages-entry

# %% role="mistake" name="with .py" says="The file is named as in an import, without .py."
def entry_point(executable, package, file, function):
    return f"{executable} = {package}.{file}.py:{function}"

# %% role="mistake" name="a slash" says="Between the package and its file stands a dot, as in an import. A slash belongs to paths."
def entry_point(executable, package, file, function):
    return f"{executable} = {package}/{file}:{function}"

# %% role="mistake" name="without the package" says="The file is in the folder of the package: after = comes the name of the package, a dot, and the file."
def entry_point(executable, package, file, function):
    return f"{executable} = {file}:{function}"

# %% role="mistake" name="a dot before the function" says="Before the function stands a colon, not a dot."
def entry_point(executable, package, file, function):
    return f"{executable} = {package}.{file}.{function}"

# %% role="mistake" name="a call" says="The line only names the function. The executable calls it: write no parentheses."
def entry_point(executable, package, file, function):
    return f"{executable} = {package}.{file}:{function}()"

# %% role="mistake" name="no spaces" says="ROS reads this line too, but the task asks for one space on each side of =."
def entry_point(executable, package, file, function):
    return f"{executable}={package}.{file}:{function}"

# %% role="mistake" name="the command" says="This is the command that starts the executable. The task asks for the line of setup.py that makes it."
def entry_point(executable, package, file, function):
    return f"ros2 run {package} {executable}"

# %% role="mistake" name="no f" says="The names in braces are not replaced, because the f before the quotes is missing: f\"...\"."
def entry_point(executable, package, file, function):
    return "{executable} = {package}.{file}:{function}"
