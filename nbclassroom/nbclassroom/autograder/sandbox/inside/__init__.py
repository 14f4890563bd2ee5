"""What the autograder runs inside the sandbox. It knows no answer, and nothing outside trusts it."""

import struct

MIME = "application/vnd.nbclassroom.answer+json"  # of what a check cell shows
PLACE = struct.Struct("ii")  # of the statement of a page that runs: the numbers of its cell, and in it
