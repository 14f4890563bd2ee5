"""What the autograder runs inside the sandbox. It knows no answer, and nothing outside trusts it."""

MIME = "application/vnd.nbclassroom.answer+json"  # of what a check cell shows
