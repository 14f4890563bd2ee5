"""The secret seed of a key.

Somebody who guesses the seed can compute every hidden input, so a seed has at least 128 bits drawn by chance.
"""

import re
import secrets

from .answer_key import KeyFolderError

DIGITS = 32  # hexadecimal: 128 bits


def require_unguessable(seed):
    """KeyFolderError for a seed that can be guessed; nobody can tell how many bits are in a phrase."""
    if not re.fullmatch(rf"[0-9a-fA-F]{{{DIGITS},}}", seed) or seed.isdecimal():
        raise KeyFolderError(
            f"this seed can be guessed: expected at least {DIGITS} hexadecimal digits drawn by chance, 128"
            " bits; leave --seed out, and a seed is made, or draw one: openssl rand -hex 16"
        )


def read_or_make_seed(path):
    """The secret seed in a file that only its owner can read; without such a file, one is made and stored."""
    if path.exists():
        seed = path.read_text(encoding="utf-8").strip()
        require_unguessable(seed)
        return seed
    seed = secrets.token_hex(DIGITS // 2)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch(mode=0o600)
    path.write_text(f"{seed}\n", encoding="utf-8")
    return seed
