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
        ("for w in words:\n    count += w", {"words", "count"}),
        ("class A:\n    w = least\n    k = w", {"least"}),
    ],
)
def test_the_names_that_a_statement_reads_before_it_binds_them(source, reads):
    [statement] = names_used(source)
    assert statement.reads == reads
