"""Atomic writes: a reader finds the old file or folder or the new one, never a part of either."""

import secrets
import tempfile
from pathlib import Path


def write_file(path, data, permissions=None):
    """Write a file whole, text as UTF-8; after an OSError a file that was there stays as it was."""
    data = data.encode("utf-8") if isinstance(data, str) else data
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".writing-{secrets.token_hex(8)}.tmp")
    try:
        # A private file is private from its first byte on.
        temporary.touch(mode=0o666 if permissions is None else permissions, exist_ok=False)
        temporary.write_bytes(data)
        if permissions is not None:
            temporary.chmod(permissions)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def write_folder(path, files, permissions):
    """Write a folder whole, {relative name: text}, in place of one that is there."""
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
