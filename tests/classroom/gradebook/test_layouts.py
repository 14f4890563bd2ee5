"""Whose a file is: one folder as each platform makes it, groups, patterns, and what is in doubt."""

import pytest
from nbclassroom.gradebook.archives import CollectError
from nbclassroom.gradebook.layouts import FolderLayout

LESSONS = ("light", "sound", "light_node")
FOLDERS = {  # name: (layouts, {path: learner})
    "Moodle": (
        ["Moodle"],
        {
            "Ada Lovelace_12345_assignsubmission_file_/x.ipynb": "Ada Lovelace",
            "Jörg Öz_12346_assignsubmission_file/work.zip/20_light.ipynb": "Jörg Öz",
            "Bob_7_assignsubmission_file_Cy_8_assignsubmission_file_.ipynb": "Bob",
            "Group A_31_assignsubmission_file/x.ipynb": "Group A",
            "Default group_assignsubmission_file/x.ipynb": "Default group",
        },
    ),
    "Moodle's zip in a group's": (
        ["Moodle"],
        {
            "Monday/class.zip/Ada_1_assignsubmission_file_/Bob_2_assignsubmission_file_/x.ipynb": "Ada",
            "Tuesday.zip/Bob_2_assignsubmission_file_/x.ipynb": "Bob",
        },
    ),
    "Canvas": (
        ["Canvas"],
        {
            "lovelaceada_LATE_77_100_20_light-1.ipynb": "lovelaceada",
            "raybob_78_101_work.zip/bob_1_2_x.ipynb": "raybob",
            "LATE_anon_x7Yz_102_20_light.ipynb": "anon_x7Yz",
            "doejo_LATE_79_text.html": "doejo",
        },
    ),
    "ILIAS": (
        ["ILIAS"],
        {
            "sheet.zip/Sheet 1/Abgaben/Lovelace_Ada_ada_17/20_light.ipynb": "Ada Lovelace",
            "sheet.zip/Sheet 1/Abgaben/Team 3/Ray_Bob_bob_18/20_light.ipynb": "Team 3",
            "Feedback/Sheet 2/Ray_Cy Al_cyr_19/x.ipynb": "Cy Al Ray",
        },
    ),
    "nbgrader": (
        ["nbgrader"],
        {"submitted/ada/ps1/20_light.ipynb": "ada", "submitted/bob/ps1/20_light.ipynb": "bob"},
    ),
    "nbgrader, as learners send it": (
        ["nbgrader"],
        {
            "ada+ps1+2026-11-20 10:00:00.000000 UTC+dGVz/20_light.ipynb": "ada",
            "bob+ps1+2026-11-20 11:00:00.000000 UTC/20_light.ipynb": "bob",
        },
    ),
    "Google Classroom": (
        ["{learner} - *.ipynb"],
        {
            "Ada Lovelace - 20_light (1).ipynb": "Ada Lovelace",
            "Bob - Copy of mine.ipynb": "Bob",
            "Ann - Lee - 20_light - final.ipynb": "Ann - Lee",
            "Copy of Cy Ray - 20_light.ipynb": "Cy Ray",
        },
    ),
    "Google Classroom, the name last, in a folder": (
        ["{group}/* - {learner}.ipynb"],
        {
            "Week 1/20_light - Ada.ipynb": "Ada",
            "Week 1/Copy of 20_light - Bob.ipynb": "Bob",
            "Week 1/20_light - Ann - Lee.ipynb": "Ann - Lee",
        },
    ),
    "a folder, a file or a zip a learner": (
        ["{learner}"],
        {
            "01_ada/20_light.ipynb": "01_ada",
            "bob/20_light_node.ipynb.txt": "bob",
            "cy_20_light-1.ipynb": "cy",
            "20_light_di.IPYNB": "di",
            "student (2).ipynb": "student (2)",
            "eve highlight-1.ipynb": "eve highlight-1",
            "fay_20_light.zip/my/20_light.ipynb": "fay",
            "eve/bob_1_2_20_light.ipynb": "eve",
            "eve/Bob_1_assignsubmission_file_/x.ipynb": "eve",
            "gus.zip/": "gus",
            "my_last_try_3/20_light.ipynb": "my_last_try_3",  # one such folder is not ILIAS
            "hal - Kopie (2).ipynb": "hal",
            "Copy of ivy_20_light.ipynb": "ivy",
            "kim-Copy1/20_light.ipynb": "kim",
            "light-leo/20_light.ipynb": "leo",
        },
    ),
    "a folder a lesson": (
        ["{group}/{learner}"],
        {"light/ada.ipynb": "ada", "21_sound/ada.ipynb": "ada", "light/bob/x.ipynb": "bob"},
    ),
    "folders of learners in groups": (
        ["{group}/{learner}"],
        {"A/ada/20_light.ipynb": "ada", "A/bob/20_light.ipynb": "bob", "B.zip/cy/20_light.ipynb": "cy"},
    ),
    "groups in a zip's folder": (
        ["{group}/{group}/{learner}"],
        {"all/A/ada/20_light.ipynb": "ada", "all/A/bob/20_light.ipynb": "bob", "all/B/cy.ipynb": "cy"},
    ),
}


def learners(paths, given=(), folder="submissions"):
    layout = FolderLayout(folder, LESSONS, list(paths), given)
    return layout.layouts, {path: layout.sender_of(path).learner for path in paths}


@pytest.mark.parametrize("name", FOLDERS)
def test_a_folder_names_its_learners(name):
    assert learners(FOLDERS[name][1]) == FOLDERS[name]


def test_numbers_of_platforms_and_lateness_are_in_the_names():
    path = "class.zip/lovelaceada_LATE_77_100_20_light-1.ipynb"
    sender = FolderLayout("submissions", LESSONS, [path]).sender_of(path)
    assert (sender.platform, sender.platform_id, sender.late) == ("canvas", "77", True)
    assert (sender.place, sender.version) == ("class.zip/", ("20_light", 100))


def test_a_platforms_folder_can_be_given_itself():
    paths = {"Team 3/Ray_Bob_bob_18/x.ipynb": "Team 3", "Lovelace_Ada_ada_17/x.ipynb": "Ada Lovelace"}
    assert learners(paths, folder="Abgaben") == (["ILIAS"], paths)
    paths = {"ada/ps1/20_light.ipynb": "ada", "ada/ps2/21_sound.ipynb": "ada"}
    assert learners(paths, folder="submitted") == (["nbgrader"], paths)


@pytest.mark.parametrize(
    ("given", "paths"),
    [
        (["{group}/{learner}/*.ipynb"], {"A/ada/x.ipynb": "ada", "A.zip/bob.zip/y.ipynb": "bob"}),
        (["{group}/{learner}"], {"A/ada.ipynb": "ada", "A/bob.ipynb": "bob", "B/cy/x.ipynb": "cy"}),
        (["{learner}_hw*.ipynb"], {"ada_hw1.ipynb": "ada", "bob_hw_final.ipynb": "bob"}),
        (["**/{lesson}/{learner}.ipynb"], {"x/y/20_light/ada.ipynb": "ada", "sound/bob.ipynb": "bob"}),
        (
            ["{learner}", "moodle"],
            {"all.zip/Ada_1_assignsubmission_file_/x.ipynb": "Ada", "Bob Ray.ipynb": "Bob Ray"},
        ),
    ],
)
def test_a_pattern_settles_it(given, paths):
    assert learners(paths, given)[1] == paths


DOUBTS = {  # name: (paths, lines)
    "folders, or groups of files": (
        ["A/ada.ipynb", "A/bob.ipynb", "A/bob sound.ipynb"],
        [
            "several layouts fit, and they name different learners:",
            "  A/ada.ipynb: A or ada",
            "  A/bob sound.ipynb: A or bob",
            "  A/bob.ipynb: A or bob",
            'Give one: --layout "{learner}" or --layout "{group}/{learner}".',
        ],
    ),
    "a name first or last": (
        ["Ada - mine.ipynb", "Bob - my own.ipynb"],
        [
            "several layouts fit, and they name different learners:",
            "  Ada - mine.ipynb: Ada or mine",
            "  Bob - my own.ipynb: Bob or my own",
            'Give one: --layout "{learner} - *.ipynb" or --layout "* - {learner}.ipynb".',
        ],
    ),
    "a lesson is nobody": (
        ["ada.ipynb", "bob.ipynb", "20_light.ipynb", "21_sound (1).ipynb"],
        [
            'nothing says whose these are; 2 others fit --layout "{learner}":',
            "  20_light.ipynb",
            "  21_sound (1).ipynb",
            'Move or rename them, or give a layout for them, too: --layout "{learner}".',
        ],
    ),
    "a platform's names beside others": (
        [
            "class.zip/Ada_1_assignsubmission_file_/x.ipynb",
            "Bob_2_assignsubmission_file_/x.ipynb",
            "cy.ipynb",
        ],
        [
            'nothing says whose these are; 2 others fit --layout "Moodle":',
            "  cy.ipynb",
            'Move or rename them, or give a layout for them, too: --layout "Moodle" --layout "{learner}".',
        ],
    ),
    "Canvas's names in a folder, Moodle's in another, beside others": (
        [
            *("all/raybob_78_101_x.ipynb", "all/lovelaceada_77_100_x.ipynb", "more/cy.ipynb"),
            "all/Di_1_assignsubmission_file_/x.ipynb",
        ],
        [
            'nothing says whose these are; 1 others fit --layout "Moodle":',
            "  all/lovelaceada_77_100_x.ipynb",
            "  all/raybob_78_101_x.ipynb",
            "  more/cy.ipynb",
            "Move or rename them, or give a layout for them, too: "
            '--layout "Moodle" --layout "Canvas" --layout "{learner}".',
        ],
    ),
    "the folder of an nbgrader course": (
        ["submitted/ada/ps1/x.ipynb", "submitted/bob/ps1/x.ipynb", "release/ps1/20_light.ipynb"],
        [
            'nothing says whose these are; 2 others fit --layout "nbgrader":',
            "  release/ps1/20_light.ipynb",
            'Move or rename them, or give a layout for them, too: --layout "nbgrader" --layout "{learner}".',
        ],
    ),
    "files as their learners named them": (
        ["20_light.ipynb", "20_light (1).ipynb", "Copy of 20_light.ipynb", "20_light - Kopie.ipynb"],
        [
            "nothing says whose these are:",
            "  20_light (1).ipynb",
            "  20_light - Kopie.ipynb",
            "  20_light.ipynb",
            "  Copy of 20_light.ipynb",
            """Put each learner's name into the name of a folder or a file, such as "Ada - FILE.ipynb".""",
        ],
    ),
}


@pytest.mark.parametrize("name", DOUBTS)
def test_what_is_in_doubt_stops_with_a_list_and_what_settles_it(name):
    paths, (text, *lines) = DOUBTS[name]
    with pytest.raises(CollectError) as stopped:
        learners(paths)
    assert str(stopped.value).splitlines() == [f"nothing was graded: {text}", *lines]
    assert stopped.value.exit_code == 3


def test_a_path_that_a_given_layout_does_not_read_stops_too():
    with pytest.raises(CollectError, match=r"1 others fit --layout \"\{group\}/\{learner\}/\*\.ipynb\""):
        learners(["A/ada/x.ipynb", "A/ada/deeper/x.ipynb"], ["{group}/{learner}/*.ipynb"])


@pytest.mark.parametrize(
    "text", ["{leaner}/*", "{group}/*", "{learner}/{learner}", "{learner", "moodel", "{}"]
)
def test_what_is_no_layout_is_refused_in_one_line(text):
    with pytest.raises(
        ValueError, match="is no layout; give Moodle, Canvas, ILIAS, nbgrader, or a pattern"
    ) as bad:
        learners(["ada.ipynb"], [text])
    assert "\n" not in str(bad.value)


def test_a_long_list_is_cut():
    with pytest.raises(CollectError, match="\n  and 11 more\n"):
        learners([f"A/{number}.ipynb" for number in range(31)])
