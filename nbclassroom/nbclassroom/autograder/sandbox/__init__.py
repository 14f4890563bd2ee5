"""Run learners' code: the sandbox, the kernels in it, and what they contain (`inside`).

`inside/` is mounted into the sandbox and is all of the autograder that exists there. It knows no answer,
compares nothing, and nothing outside trusts it.
"""
