"""The learner's kernel: where it runs (`sandbox`), how nbval talks to it (`running`), and what is inside.

`inside/` is mounted into the sandbox and is all of the grader that stands there. It holds no answer, compares
nothing, and is not trusted by anything outside.
"""
