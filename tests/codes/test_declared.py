"""Claims about declarations of programs: key, version, schemes, knobs, and what is refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.declared_program import ASK, DECLARED
from vv.ask import Ask, Displacement, Knobs, Method
from vv.base.errors import UsageError
from vv.codes import program
from vv.codes.adapter import known_beforehand
from vv.codes.program import question
from vv.scene import Form, Term


def test_its_key_hangs_on_the_toml_its_command_and_the_files_it_names(tmp_path: Path) -> None:
    for name in ("program.sh", "law.txt"):
        (tmp_path / name).write_text("")
    file = tmp_path / "mine.toml"
    file.write_text('files = ["law.txt"]\n' + DECLARED.format(command="sh program.sh"))
    names = {path.name for path in program.load(file).found().files}
    assert {"mine.toml", "program.sh", "law.txt"} < names
    assert any(path.name in ("sh", "dash", "bash") for path in program.load(file).found().files)


@pytest.mark.parametrize(
    ("command", "version"),
    [
        ("echo 2.1", "2.1"),
        ("false", "version not stated"),
        ("./nowhere", "version not stated: FileNotFoundError"),
    ],
)
def test_it_is_asked_its_version(tmp_path: Path, command: str, version: str) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(f'version = "{command}"\n' + DECLARED.format(command="true"))
    assert program.load(file).found().version == version


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("command", "comand", "comand = 'true'; there is no such entry; did you mean command?"),
        ('command = "true"', "", "command is missing; the words that start the program"),
        ('"true"', "7", "command = 7; it must be a list of texts"),
        ('"true"', '""', "command = ''; it must name a program"),
        ("[scheme.default]", "[scheme]", "scheme.method = 'second-order'; it must be a table"),
        ("second-order", "second", "scheme.default.method = 'second'; unknown; did you mean"),
        ('method = "second-order"', "", "scheme.default.method is missing; its class of method"),
        ('"drag"', '"drug"', "scheme.default.terms[1] = 'drug'; unknown; did you mean drag?"),
        ('"velocity"', '"speed"', "scheme.default.observables[1] = 'speed'; unknown; known: disp"),
        ('"kinetic"', '"heat"', "scheme.default.energies[0] = 'heat'; unknown"),
        ("energies", "knobs", "scheme.default.knobs[0] = 'kinetic'; unknown; known: dd, dt, kn"),
        ("energies", "pace", "scheme.default.pace = ['kinetic']; it must be [CPU seconds of a"),
        ('energies = ["kinetic"]', 'lowered = {drag = "slow"}', "lowered.drag = 'slow'; unknown"),
        ('energies = ["kinetic"]', 'why-not = {drag = "?"}', "has Term.DRAG, which its terms have"),
        ("command =", "command", "Expected '=' after a key"),
        ("command", 'files = ["law"]\ncommand', "files = ['law']; there is no file"),
    ],
)
def test_a_declaration_that_is_not_right_is_refused_by_name(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    file = tmp_path / "mine.toml"
    text = DECLARED.format(command="true")
    assert old in text
    file.write_text(text.replace(old, new))
    with pytest.raises(UsageError) as caught:
        program.load(file)
    assert message in str(caught.value)
    assert str(caught.value).startswith(str(file))


def test_a_declaration_says_what_a_scheme_can_do(tmp_path: Path) -> None:
    file = tmp_path / "my_dem.toml"
    more = 'knobs = []\npace = [1e-6, 2e-7]\nlowered = {drag = "first-order"}\n'
    file.write_text(DECLARED.format(command="true") + more + 'why-not = {friction = "no shear"}\n')
    code = program.load(file)
    (scheme,) = code.schemes
    assert (code.name, scheme.name, scheme.knobs, scheme.pace) == (
        "my-dem",
        "default",
        (),
        (1e-6, 2e-7),
    )
    assert scheme.method_for(frozenset({Term.DRAG})) is Method.FIRST_ORDER
    assert scheme.energies == {Form.KINETIC}
    unseen = Ask(ASK.scene, ASK.goal, (Displacement(0),), Knobs(dt=1.0))
    run = known_beforehand(code, scheme, unseen, code.found())
    assert run is not None
    assert "longer than" in run.reason


def test_the_question_says_only_what_the_scheme_has_of_knobs() -> None:
    assert json.loads(question.text(ASK, "default", ()))["knobs"] == {}
    assert json.loads(question.text(ASK, "default", ("dt",)))["knobs"] == {"dt": 1e-3}
