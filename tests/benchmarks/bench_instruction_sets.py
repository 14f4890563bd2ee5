"""Whether the stored outputs of every lesson hold on an older processor: stock nbval, without AVX2 and FMA.

NumPy, the C library, OpenCV and OpenBLAS choose their code by the processor's instruction sets. Their own
environment variables switch some of them off. A probe first makes sure that this has happened.

    environment/test --benchmarks instruction_sets
    .venv/bin/python tests/benchmarks/bench_instruction_sets.py --lesson canny_stages --lesson obstacles_ahead
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import click

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
NUMPY = "X86_V3 X86_V4 AVX512_ICL AVX512_SPR"  # NumPy 2.4 knows levels: X86_V3 is AVX2 and FMA
OPENCV = "AVX512-SKX AVX2 FMA3 FP16"
# Of the names in the arguments, those that NumPy and OpenCV use now. The numbers are cv::CpuFeatures.
PROBE = """
import cv2, sys
from numpy._core._multiarray_umath import __cpu_features__ as features
numbers = {"AVX512-SKX": 256, "AVX2": 11, "FMA3": 12, "FP16": 9}
print(*(
    name for name in sys.argv[1:]
    if (cv2.checkHardwareSupport(numbers[name]) if name in numbers else features.get(name))
))
"""
# Only nbval: no other plugin, and none of the course's.
NBVAL = ["-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "nbval.plugin", "--nbval"]
PYTESTS_OWN = ("MPLBACKEND", "PYTEST_ADDOPTS", "PYTHONPATH")


def run(arguments, variables):
    environment = {name: value for name, value in os.environ.items() if name not in PYTESTS_OWN} | variables
    environment |= {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTHONWARNINGS": "ignore"}
    command = [sys.executable, *arguments]
    return subprocess.run(command, env=environment, cwd=NOTEBOOKS.parent, capture_output=True, text=True)


def used(variables):
    """Those of the names that NumPy and OpenCV use in a process with these variables."""
    return run(["-c", PROBE, *NUMPY.split(), *OPENCV.split()], variables).stdout.split()


def variables_of_an_older_processor():
    """The environment variables that switch these off."""
    names = used({})
    # Only what is there: OpenCV prints a warning of each other name, and a lesson would show it.
    variables = {
        "NPY_DISABLE_CPU_FEATURES": " ".join(name for name in NUMPY.split() if name in names),
        "OPENCV_CPU_DISABLE": ",".join(name for name in OPENCV.split() if name in names),
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F",
        "OPENBLAS_CORETYPE": "Nehalem",
    }
    if not names or used(variables):
        raise click.ClickException(f"of {names or 'nothing'} {used(variables)} could not be switched off")
    return variables


def differing_cells(lesson, variables):
    """The cells of one lesson whose outputs differ; what pytest says if it ended early."""
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copy(lesson, folder)  # what a lesson writes lands beside the copy
        for module in NOTEBOOKS.glob(f"{lesson.stem[3:]}.py"):
            shutil.copy(module, folder)
        result = run([*NBVAL, copy], variables | {"IPYTHONDIR": f"{folder}/.ipython"})
    failed = re.findall(r"^(?:FAILED|ERROR) .*::(Cell \d+)", result.stdout, re.MULTILINE)
    return failed or ([result.stdout[-500:] + result.stderr[-500:]] if result.returncode else [])


@click.command()
@click.option("--lesson", "names", multiple=True, help="Only this lesson (may be repeated).")
def main(names):
    variables, differing = variables_of_an_older_processor(), {}
    for path in sorted(NOTEBOOKS.glob("[0-9]*_*.ipynb")):
        if not names or path.stem[3:] in names:
            differing[path.stem] = differing_cells(path, variables)
            print(f"{path.stem}: {', '.join(differing[path.stem]) or 'no cell differs'}", flush=True)
    sys.exit(not differing or any(differing.values()))


if __name__ == "__main__":
    main()
