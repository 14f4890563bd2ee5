"""A package, so that pytest ends its fixtures (a browser, a JupyterLab) after its last test."""
