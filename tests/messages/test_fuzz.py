"""A bounded run of fuzz.py; the full run is `python tests/messages/fuzz.py --count 1000000`."""

import importlib.util
from pathlib import Path

SPEC = importlib.util.spec_from_file_location("messages_fuzz", Path(__file__).with_name("fuzz.py"))
fuzz = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(fuzz)


def test_malformed_messages_raise_nothing_but_conversion_error(capfd):
    fuzzer = fuzz.Fuzzer(seed=8)
    with capfd.disabled(), fuzz.captured_stderr():
        fuzzer.run(8_000)
    for kind in ("image", "compressed", "array"):  # otherwise the fuzz tests nothing
        assert fuzzer.outcomes[f"{kind} converted"] > 10
        assert fuzzer.outcomes[f"{kind} refused"] > 100
    assert 1 < fuzzer.largest["image"][0] < fuzz.IMAGE_MULTIPLE
