"""Block slow imports that reading a notebook does not need; the nbval process loads this module first.

jsonschema uses them, if they are installed, to check addresses, durations and colors. `rfc3987_syntax` builds
a grammar when it is imported, which takes a second; `rfc3986_validator` compiles long patterns, and
`isoduration` imports a calendar.
"""

import sys

for _name in ("rfc3987_syntax", "rfc3986_validator", "isoduration", "webcolors"):
    sys.modules.setdefault(_name, None)  # type: ignore[arg-type]  # by None Python blocks an import
