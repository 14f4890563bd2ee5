"""Which names a statement of a master's cell reads."""

import pytest
from nbclassroom.authoring.names_used import names_used


@pytest.mark.parametrize(
    ("source", "reads"),
    [
        ("x = [w for w in words]", {"words"}),
        ("x = {w: k for w, k in pairs if w in known}", {"pairs", "known"}),
        ("x = {w for w in words}, w", {"words", "w"}),
        ("x = [[k * w for k in row] for row in [*{s for s in rows}]]", {"w", "rows"}),
        ("def f(a):\n    return [w + bias for w in a], {k: k for k in a}", {"bias"}),
        ("def f(a):\n    return [w for w in a], w", {"w"}),
        ("def f(a=[w for w in words]):\n    return (w for w in a)", {"words"}),
        ("class A:\n    names = [w for w in words]\n    f = lambda self: {w for w in self}", {"words"}),
        ("f = lambda a: [w for w in a if w > least]", {"least"}),
        ("for w in [w for w in words]:\n    print(w)", {"print", "words"}),
        ("x = [w := k for k in words], w", {"words", "w"}),
    ],
)
def test_the_variable_of_a_comprehension_is_no_name_that_a_statement_reads(source, reads):
    [statement] = names_used(source)
    assert statement.reads == reads
