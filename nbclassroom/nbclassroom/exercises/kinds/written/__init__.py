"""Written answers: text, or a figure, which a person grades by a rubric."""
