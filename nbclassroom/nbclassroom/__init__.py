"""A classroom for any notebook course: what an answer is, lessons from masters, results, and grades."""
