"""Atomic writes: a reader finds the old file or folder or the new one, never a part of either."""

import contextlib
import os
import secrets
import tempfile
from pathlib import Path


def write_file(path, data, permissions=None):
    """Write a file whole.

    Parameters
    ----------
    path : Path; its folder is made if it is missing
    data : str (stored as UTF-8) or bytes
    permissions : int, such as 0o600; the process's default if omitted

    Raises
    ------
    OSError : the disk is full or read-only; a file that was there stays as it was
    """
    temporary = stage_file(path, data, permissions)
    try:
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def stage_file(path, data, permissions=None, *, sync=False):
    """Write a hidden temporary file beside a path, which the caller then moves to that path.

    Parameters
    ----------
    path, data, permissions : as in `write_file`
    sync : bool, wait until the data is on the disk

    Returns
    -------
    Path of the temporary file

    Raises
    ------
    OSError : as in `write_file`; no temporary file is left
    """
    data = data.encode("utf-8") if isinstance(data, str) else data
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".writing-{secrets.token_hex(8)}.tmp")
    with contextlib.ExitStack() as cleanup:
        cleanup.callback(temporary.unlink, missing_ok=True)
        # A private file is private from its first byte on.
        temporary.touch(mode=0o666 if permissions is None else permissions, exist_ok=False)
        with temporary.open("wb") as file:
            file.write(data)
            if sync:
                file.flush()
                os.fsync(file.fileno())
        if permissions is not None:
            temporary.chmod(permissions)
        cleanup.pop_all()
    return temporary


def write_folder(path, files, permissions):
    """Write a folder whole, in place of a folder that is there.

    Parameters
    ----------
    path : Path
    files : dict {relative name: str}
    permissions : int, of the folder itself

    Raises
    ------
    OSError : the disk is full or read-only
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=".writing-") as work_folder:
        new_folder = Path(work_folder) / "new"
        for name, text in files.items():
            file = new_folder / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        new_folder.chmod(permissions)
        if path.exists():
            path.rename(Path(work_folder) / "old")
        new_folder.rename(path)
