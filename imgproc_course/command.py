"""The program `imgproc-course`; without what its commands need it names what to install."""

import sys


def main():
    try:
        from imgproc_course.cli import main as run
    except ModuleNotFoundError as error:
        module = (error.name or "").partition(".")[0]
        what = "./nbclassroom" if module == "nbclassroom" else '".[lab]" ./nbclassroom'
        sys.exit(f"imgproc-course needs {module}; in the checkout of the course: pip install {what}")
    run()
