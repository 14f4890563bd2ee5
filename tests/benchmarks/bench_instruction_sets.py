"""Whether the stored outputs of every lesson hold on older processors: stock nbval, newer instructions off.

NumPy, the C library, OpenCV and OpenBLAS choose their code by the processor's instruction sets. Their own
environment variables switch some of them off. A probe first makes sure that this has happened: what a
processor lacks anyway, or a library ignores, would measure nothing.

    environment/test --benchmarks instruction_sets
    .venv/bin/python tests/benchmarks/bench_instruction_sets.py --lesson canny_stages --lesson obstacles_ahead
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
# What is switched off: of NumPy, of OpenCV, of the C library; and the processor whose code OpenBLAS takes.
# NumPy 2.4 knows levels: X86_V3 is AVX2 and FMA, X86_V4 is AVX-512.
SETS = {
    "as it is": ("", "", "", ""),
    "without AVX-512": ("X86_V4 AVX512_ICL AVX512_SPR", "AVX512-SKX", "-AVX512F", "Haswell"),
    "without AVX2 and FMA": (
        "X86_V3 X86_V4 AVX512_ICL AVX512_SPR",
        "AVX512-SKX AVX2 FMA3 FP16",
        "-AVX2,-FMA,-AVX512F",
        "Nehalem",
    ),
}
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


def environment_with(variables):
    environment = {name: value for name, value in os.environ.items() if name not in PYTESTS_OWN}
    return environment | variables | {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTHONWARNINGS": "ignore"}


def used(names, variables):
    """Those of the names that NumPy and OpenCV use in a process with these variables."""
    command = [sys.executable, "-c", PROBE, *names]
    return subprocess.run(
        command, env=environment_with(variables), capture_output=True, text=True, check=True
    ).stdout.split()


def variables_without(numpy_names, opencv_names, tunables, coretype):
    """The environment variables that switch these off, or None if this processor has none of them.

    Raises
    ------
    click.ClickException : one of them could not be switched off
    """
    names = used([*numpy_names.split(), *opencv_names.split()], {})
    if not numpy_names or not names:
        return {} if not numpy_names else None
    # Only what is there: OpenCV prints a warning of each other name, and a lesson would show it.
    variables = {
        "NPY_DISABLE_CPU_FEATURES": " ".join(name for name in numpy_names.split() if name in names),
        "OPENCV_CPU_DISABLE": ",".join(name for name in opencv_names.split() if name in names),
        "GLIBC_TUNABLES": f"glibc.cpu.hwcaps={tunables}",
        "OPENBLAS_CORETYPE": coretype,
    }
    left = used(names, variables)
    if left:
        raise click.ClickException(f"{', '.join(left)} could not be switched off")
    return variables


def run_nbval(lesson, variables):
    """(cells that agree, the cells that do not, seconds) of one lesson."""
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copy(lesson, folder)  # what a lesson writes lands beside the copy
        for module in NOTEBOOKS.glob(f"{lesson.stem[3:]}.py"):
            shutil.copy(module, folder)
        result = subprocess.run(
            [sys.executable, *NBVAL, copy],
            cwd=NOTEBOOKS.parent,
            env=environment_with(variables | {"IPYTHONDIR": f"{folder}/.ipython"}),
            capture_output=True,
            text=True,
        )
    passed = re.search(r"(\d+) passed", result.stdout)
    failed = re.findall(r"^(?:FAILED|ERROR) .*::(Cell \d+)", result.stdout, re.MULTILINE)
    if result.returncode and not failed:
        failed = [result.stdout[-500:] + result.stderr[-500:]]
    return int(passed[1]) if passed else 0, failed, time.monotonic() - start


@click.command()
@click.option("--lesson", "names", multiple=True, help="Only this lesson (may be repeated).")
def main(names):
    lessons = [
        path for path in sorted(NOTEBOOKS.glob("[0-9]*_*.ipynb")) if not names or path.stem[3:] in names
    ]
    table = Table("lesson", "instruction sets", "cells", "differ", "s")
    has_failed = not lessons
    for name, switched_off in SETS.items():
        variables = variables_without(*switched_off)
        if variables is None:
            print(f"{name}: this processor has none of them anyway; not measured")
            continue
        for lesson in lessons:
            passed, failed, seconds = run_nbval(lesson, variables)
            has_failed |= bool(failed)
            table.add_row(lesson.stem, name, str(passed), ", ".join(failed) or "none", f"{seconds:.0f}")
    Console(width=110).print(table)
    sys.exit(has_failed)


if __name__ == "__main__":
    main()
