"""A program's TOML file and a project's settings of wrong types are told of in a line."""

from __future__ import annotations

from pathlib import Path

import pytest

from vv.base.errors import UsageError
from vv.codes import program
from vv.plan.content import settings

GIVEN = {
    "command": '"true"', "version": '["true"]', "files": '["a.txt"]', "install": '"brew"',
}  # fmt: skip
SCHEME = {
    "method": '"second-order"', "terms": '["sphere", "drag"]', "observables": '["displacement"]',
    "energies": '["kinetic"]', "knobs": '["dt"]', "summary": '"fast"',
    "lowered": '{drag = "first-order"}', "why_not": '{gravity = "none here"}', "pace": "[1e-6, 0]",
}  # fmt: skip
OTHERS = ("true", "3", "-1.5", "nan", "inf", '""', '"a"', '"\\""', '"\\u0000"', '"\\u001b[31m"',
          "[]", "[1]", '["a", 1]', '[""]', '["\\u0000"]', "{}", "{a = 1}", '{a = "a"}', "[[[]]]",
          "2027-01-01", "1e300", "[-1, 0]", "[nan, 0]", '["dt", "dt"]')  # fmt: skip


def written(path: Path, place: str, other: str) -> None:
    top = [f"{n} = {other if n == place else v}" for n, v in GIVEN.items()]
    low = [f"{n} = {other if n == place else v}" for n, v in SCHEME.items()]
    path.write_text("\n".join([*top, "[scheme.default]", *low]))


@pytest.mark.parametrize("place", [*GIVEN, *SCHEME])
def test_a_declaration_of_wrong_types_is_named_or_read(tmp_path: Path, place: str) -> None:
    path, refused = tmp_path / "mine.toml", 0
    for other in OTHERS:
        written(path, place, other)
        said = ""
        try:
            program.load(path).found()
        except UsageError as error:
            said = str(error)
        assert said == "" or said.startswith(f"{path}: ")
        assert "\n" not in said
        refused += bool(said)
    assert refused >= len(OTHERS) // 2


@pytest.mark.parametrize("text", ["alone = 3", "alone = 'yes'", "other = 1", "alone = ", "\x00"])
@pytest.mark.parametrize("name", ["vv.toml", "pyproject.toml"])
def test_settings_of_a_project_of_wrong_types_are_named(
    tmp_path: Path, name: str, text: str
) -> None:
    (tmp_path / "cases").mkdir()
    (tmp_path / name).write_text(text if name == "vv.toml" else f"[tool.vv]\n{text}")
    with pytest.raises(UsageError, match=name) as refused:
        settings(tmp_path)
    assert "\n" not in str(refused.value)
