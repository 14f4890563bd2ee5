"""The teacher's page of all drives: a map of each, those of hidden scenarios, too."""

from .report import label_of, map_of, render_page


def drives_page(learners, store, names):
    """The page, HTML; "" if nothing drove. `names` are {learner's name: the name to show}."""
    views = {}
    for learner in learners:
        for digest in learner.digests.values():
            result = store.result(digest)
            for exercise in result.exercises if result else ():
                for case in filter(lambda case: case.drive, exercise.cases):
                    drives = views.setdefault((exercise.title, case.title, case.id), [])
                    drives.append((names[learner.name], case))
    maps = {  # one scenario after another: its room is made once
        about: [
            {"name": name, "case": case, "label": label_of(case), "map": map_of(case)}
            for name, case in drives
        ]
        for about, drives in views.items()
    }
    return render_page("drives.html", views=maps) if maps else ""
