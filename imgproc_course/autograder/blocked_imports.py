"""The first thing that the judge's pytest loads: spares it what reading a notebook does not need.

jsonschema takes these where they are installed, to check addresses and durations: `rfc3987_syntax` builds a
grammar when it is imported, which takes a second, and `isoduration` brings a calendar.
"""

import sys

for _name in ("rfc3987_syntax", "isoduration"):
    sys.modules.setdefault(_name, None)
