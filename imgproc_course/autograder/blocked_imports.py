"""Block two slow imports that reading a notebook does not need; the nbval process loads this module first.

jsonschema uses them, if they are installed, to check addresses and durations. `rfc3987_syntax` builds a
grammar when it is imported, which takes a second, and `isoduration` imports a calendar.
"""

import sys

for _name in ("rfc3987_syntax", "isoduration"):
    sys.modules.setdefault(_name, None)
