"""Run answers in a sandbox, compare what they return with the answer key, and return the results."""
