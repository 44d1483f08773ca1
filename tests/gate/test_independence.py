"""Which files make a reference one with the code that it judges."""

from pathlib import Path
from typing import cast

import pytest

from tests.support.fabricated import entry, record
from vv.gate import independence
from vv.plan.plan import Plan
from vv.plan.project import Project
from vv.records.outcomes import Verdict

ONE, OTHER = "import cases.one", "import cases.other"


class _Job:
    code = "ours"


class _Plan:
    jobs = (_Job(),)
    cases = ("fall",)


class _Project:
    """A case and an adapter that stand in one folder, with all that they import."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.root = folder

    def adapter_files(self, code: str) -> list[Path]:
        return [self.folder / f"{code}.py"]

    def case_files(self) -> dict[str, Path]:
        return {"fall": self.folder / "fall.py"}


@pytest.mark.parametrize(
    ("case", "code", "common"),
    [
        ("import numpy", "import numpy", None),
        (ONE, OTHER, None),
        (ONE, ONE, "one.py"),
        (f"{ONE}\n{OTHER}", f"{OTHER}\n{ONE}", "one.py"),  # the first by name
        ("from vv.base import metrics", "from vv.base import metrics", None),  # the tool's own
        ("from vv.engines.exact import roots", "from vv.engines.exact import roots", "engines"),
    ],
)
def test_a_file_that_both_are_made_of_is_found_unless_it_is_the_tool_s(
    tmp_path: Path, case: str, code: str, common: str | None
) -> None:
    (tmp_path / "cases").mkdir()
    sources = {"fall": case, "ours": code, "cases/one": "", "cases/other": ""}
    for name, text in sources.items():
        (tmp_path / f"{name}.py").write_text(text)
    project = cast("Project", _Project(tmp_path))
    found = independence.shared_sources(project, cast("Plan", _Plan()))
    assert list(found) == ([("fall", "ours")] if common else [])
    assert all(str(common) in str(path) for path in found.values())


def test_only_what_was_judged_is_disowned_and_only_of_that_code() -> None:
    quantities = [entry(verdict, {"max": 1.0}) for verdict in ("pass", "fail", "no-reference")]
    one = record("dem/default", "T1", 1e-3, quantities=quantities)
    other = record("exact/default", "T1", 1e-3, quantities=quantities)
    failed, kept = independence.fail_dependent(
        [one, other], {("bounce", "dem"): Path("a/roots.py")}
    )
    assert [q.verdict for q in failed.quantities] == [
        Verdict.FAIL, Verdict.FAIL, Verdict.NO_REFERENCE,
    ]  # fmt: skip
    said = "the reference and the code share the source file roots.py"
    assert [q.note for q in failed.quantities] == [said, said, ""]
    assert kept == other
