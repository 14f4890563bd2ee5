"""The MIME type of what a check cell shows; in a module of its own, which imports nothing."""

MIME = "application/vnd.nbclassroom.answer+json"
