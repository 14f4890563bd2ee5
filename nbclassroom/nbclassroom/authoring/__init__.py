"""From masters to lessons: read, validate, execute, build."""
