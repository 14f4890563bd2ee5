"""What the autograder runs inside the sandbox. It knows no answer, and nothing outside trusts it."""
