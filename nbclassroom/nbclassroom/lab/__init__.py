"""JupyterLab on the learner's lessons: working copies, configuration, server."""
