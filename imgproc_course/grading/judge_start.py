"""The first thing that the judge's pytest loads: spares it a second of import time.

Where jsonschema is newer than the course's own, it brings `rfc3987_syntax`, which builds a grammar when it is
imported; checking whether a string is an internationalised address is nothing that reading a notebook needs.
"""

import sys

sys.modules.setdefault("rfc3987_syntax", None)
