"""What the sandbox holds of the grader; nothing here knows an answer, and nothing outside trusts it."""
