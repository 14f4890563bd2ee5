"""Run learners' code: the sandbox, the kernels in it, and what is mounted into it (`inside`)."""
