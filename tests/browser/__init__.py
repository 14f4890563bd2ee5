"""A package, for pytest: what lives as long as it (a browser, a JupyterLab) ends with its last test."""
