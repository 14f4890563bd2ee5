"""`python -m nbclassroom`: the commands of the course in this folder."""

from nbclassroom.cli import main

main(prog_name="python -m nbclassroom")
