"""Find the files of a module, so that a kernel can be started without it."""

import sys
from functools import lru_cache
from importlib import metadata, util
from pathlib import Path

from imgproc_course.autograder.sandbox import bubblewrap
from imgproc_course.autograder.sandbox.bubblewrap import COURSE, python_folder, site_folders


@lru_cache(maxsize=256)
def paths_of_module(module):
    """Where the files of a module are inside the sandbox.

    Parameters
    ----------
    module : str, "cv2" or "imgproc_course.imaging"

    Returns
    -------
    tuple of str, paths as seen inside; for a distribution, everything that it installed at the top level
    """
    if module.startswith("imgproc_course."):
        relative = module.split(".", 1)[1].replace(".", "/")
        return (f"{COURSE}/imgproc_course/{relative}", f"{COURSE}/imgproc_course/{relative}.py")
    top, _, submodule = module.partition(".")
    names = {top}
    if not submodule:
        for files in _files_of_distributions(top):
            names |= {file.parts[0] for file in files if file.parts[0] not in ("..", "__pycache__")}
    paths = [_path_inside(path) for name in names for path in _installed_paths(name, submodule)]
    return tuple(sorted({*paths, *_standard_library_paths(module)}))


def _files_of_distributions(top):
    """The files of each distribution that installs a top-level module.

    Like metadata.packages_distributions(), without parsing the metadata of 250 distributions, which takes a
    third of a second.
    """
    prefixes = (f"\n{top}".encode(), f'\n"{top}'.encode())
    for folder, file_list in _file_lists():
        if any(prefix in file_list for prefix in prefixes):
            files = metadata.PathDistribution(folder).files or ()
            if any(file.parts[0].partition(".")[0] == top for file in files):
                yield files


@lru_cache(maxsize=1)
def _file_lists():
    """(folder, its RECORD as bytes) of each distribution; a line end is put before the first line."""
    paths = [path for folder in site_folders() for path in folder.glob("*.dist-info/RECORD")]
    return [(path.parent, b"\n" + path.read_bytes()) for path in paths]


def _installed_paths(name, submodule):
    for folder in site_folders():
        path = folder / name / submodule.replace(".", "/") if submodule else folder / name
        yield from (
            candidate for candidate in (path, path.with_name(f"{path.name}.py")) if candidate.exists()
        )
        yield from path.parent.glob(f"{path.name}.*.so")


def _path_inside(path):
    for folder, mount_point in zip(site_folders(), bubblewrap.site_mount_points(), strict=True):
        if path.is_relative_to(folder):
            return str(Path(mount_point) / path.relative_to(folder))
    raise ValueError(f"{path} is in no folder of installed packages")


def _standard_library_paths(module):
    top = module.partition(".")[0]
    if top not in sys.stdlib_module_names:
        return
    spec = util.find_spec(top)
    base, mount_point = python_folder()
    if spec is None or not spec.origin or not Path(spec.origin).is_absolute():
        return
    path = Path(spec.origin).resolve()
    if not path.is_relative_to(base):
        return
    path = path.parent if path.name == "__init__.py" else path
    for file in (path, *path.parent.glob(f"__pycache__/{path.stem}.*.pyc")):
        yield str(mount_point / file.relative_to(base))
