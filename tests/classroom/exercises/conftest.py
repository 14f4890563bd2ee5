import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / "authoring"))  # for template_master


@pytest.fixture
def write_master(tmp_path):
    """Writes a master of one exercise, `test-double`, with parts replaced, and lets `check` find it."""

    parts = {
        "front": "# ---\n# jupyter:\n#   imgproc_course:\n#     title: Doubling\n# ---",
        "title": "# %% [markdown]\n# # Doubling",
        "given": '# %% role="given" exercise="test-double"\nLIMIT = 255',
        "exercise": (
            '# %% role="exercise"\n'
            'exercise("test-double", function="double", time_limit=0.5, hint="Widen.", exact_type=True)\n'
            "SIDE = 3"
        ),
        "answer": '# %% role="answer"\ndef double(pixels):\n    raise NotImplementedError("your turn")',
        "solution": (
            '# %% role="solution"\ndef double(pixels):\n'
            "    return np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)"
        ),
        "check": '# %% role="check"\ncheck("test-double", double)',
        "case": (
            '# %% role="case" title="Bright" points=2\ndef inputs(rng):\n'
            "    return (rng.integers(100, 256, (SIDE, 4), dtype=np.uint8),)"
        ),
        "second": (
            '# %% role="case" title="Dark" hint="Start small."\ndef inputs(rng):\n'
            "    return [(np.uint8([k, k + 1]),) for k in range(2)]"
        ),
        "hidden": (
            '# %% role="hidden" title="Any" points=3\ndef inputs(rng):\n'
            "    return (rng.integers(0, 256, (20, 20), dtype=np.uint8),)"
        ),
        "mistake": (
            '# %% role="mistake" name="wraps" says="It wraps."\ndef double(pixels):\n    return pixels * 2'
        ),
        "second mistake": (
            '# %% role="mistake" name="off by one" says="One too many."\ndef double(pixels):\n'
            "    return solution(pixels) + np.uint8(1)"
        ),
    }

    def write(name="80_doubling", **changed):
        text = "\n\n".join({**parts, **changed}.values()) + "\n"
        path = tmp_path / f"{name}.py"
        path.write_text(text, encoding="utf-8")
        return path

    return write
