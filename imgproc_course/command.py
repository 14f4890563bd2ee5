"""The program `imgproc-course`; without what its commands need it names what to install."""

import sys


def main():
    """Run a command."""
    try:
        from imgproc_course.cli import main as run
    except ModuleNotFoundError as error:
        what = "./nbclassroom" if error.name == "nbclassroom" else '".[lab]" ./nbclassroom'
        sys.exit(f"imgproc-course needs {error.name}; in the checkout of the course: pip install {what}")
    run()
