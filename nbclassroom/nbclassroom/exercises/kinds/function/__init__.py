"""Functions: an answer gets arguments, and what it returns is compared."""
