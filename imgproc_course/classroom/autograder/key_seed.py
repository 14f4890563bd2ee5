"""The secret seed of a key, and its successor for a regrade after feedback.

Somebody who guesses the seed can compute every hidden input, so a seed has at least 128 bits drawn by chance.
"""

import re
import secrets

from .answer_key import KeyFolderError

DIGITS = 32  # hexadecimal: 128 bits
_LOOKED_AT = 64  # of a longer seed's digits


def require_unguessable(seed):
    """KeyFolderError for a seed that can be guessed; nobody can tell how many bits are in a phrase."""
    digits = seed.lower()[:_LOOKED_AT]
    if not re.fullmatch(rf"[0-9a-fA-F]{{{DIGITS},}}", seed) or digits.isdecimal() or _is_pattern(digits):
        raise KeyFolderError(
            f"this seed can be guessed: expected at least {DIGITS} hexadecimal digits drawn by chance, 128"
            " bits; leave --seed out, and a seed is made, or draw one: openssl rand -hex 16"
        )


def _is_pattern(digits):
    """Whether hexadecimal digits repeat, as 0123...0123 or 0123...3210, or go in steps, as 001122... does."""
    # Three digits in a row, read from either side: by chance hardly any occur twice, in a pattern most do.
    triples = [min(digits[i : i + 3], digits[i : i + 3][::-1]) for i in range(len(digits) - 2)]
    if len(set(triples)) < 0.8 * len(triples):
        return True
    values = [int(digit, 16) for digit in digits]
    for distance in range(1, 5):
        steps = [(b - a) % 16 for a, b in zip(values, values[distance:], strict=False)]
        if max(map(steps.count, steps)) > 0.4 * len(steps):  # by chance about a fifth
            return True
    return False


def new_seed():
    """A seed of 128 bits, as 32 hexadecimal digits."""
    while True:
        seed = secrets.token_hex(DIGITS // 2)
        try:
            require_unguessable(seed)
        except KeyFolderError:
            continue  # a few in ten thousand look like a pattern
        return seed


def seed_file_of(key):
    """Where the seed of a key is saved: beside its folder."""
    return key.with_name(f"{key.name}.seed")


def read_or_make_seed(path):
    """The secret seed in a file that only its owner can read; without such a file, one is made and stored."""
    if path.exists():
        seed = path.read_text(encoding="utf-8").strip()
        require_unguessable(seed)
        return seed
    seed = new_seed()
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch(mode=0o600)
    path.write_text(f"{seed}\n", encoding="utf-8")
    return seed
