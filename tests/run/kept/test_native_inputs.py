"""Claims about the input of a code for a record: its own setting, asked for once and then kept."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests import ROOT
from tests.support.fabricated import changed, record
from vv.plan.project import find
from vv.records.job_record import Record
from vv.run.native_inputs import native_inputs

REAL = find(ROOT)
CASE = REAL.load_case("single-contact")


class Project:
    """A project with the real cases and one code, which notes what it is asked."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.asked = folder, list[tuple[str, float | None]]()
        self.load_case = REAL.load_case

    def data(self) -> Path:
        """Where results are kept."""
        return self.folder

    def load_adapter(self, name: str) -> Any:
        """The code; any other name is unknown."""
        if name != "mine":
            raise LookupError(name)
        return SimpleNamespace(native=self.native)

    def native(self, ask: Any, scheme: str) -> str:
        """The scheme, the step and the stiffness."""
        if scheme == "odd":
            raise ValueError("it cannot be written")
        self.asked.append((scheme, ask.knobs.dt))
        return f"{scheme}, {ask.knobs.dt} s, kn = {ask.scene.contact.kn:g} N/m"


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)


def of(label: str = "mine/own", dt: float = 1e-3, variant: str = "T1", **more: Any) -> Record:
    parameters = {**CASE.defaults("T1"), **more.pop("set", {})}
    return record(label, variant, dt, case="single-contact", parameters=parameters, **more)


def test_an_input_is_of_the_record_s_scheme_setting_and_parameters(project: Project) -> None:
    own: Any = project
    told = native_inputs(own)
    assert told(of()) == "own, 0.001 s, kn = 5.5e+09 N/m"
    assert told(of(dt=2e-3)) == "own, 0.002 s, kn = 5.5e+09 N/m"
    told = native_inputs(own)  # of another run: one has one set of parameters for a variant
    assert told(of("mine/other", set={"kn": 1e8})) == "other, 0.001 s, kn = 1e+08 N/m"


def test_it_is_asked_for_once_also_by_the_next_who_asks(project: Project) -> None:
    own: Any = project
    first = native_inputs(own)(of())
    assert native_inputs(own)(of()) == first
    assert len(project.asked) == 1


def test_what_has_no_key_is_not_kept(project: Project) -> None:
    own: Any = project
    told = native_inputs(own)
    assert told(of(key="")) == "own, 0.001 s, kn = 5.5e+09 N/m"
    assert told(of(dt=2e-3, key="")) == "own, 0.002 s, kn = 5.5e+09 N/m"


@pytest.mark.parametrize(
    "gone", [of(variant="T99"), of("none/own"), of("mine/odd"), changed(of(), case="no-such-case")]
)
def test_what_is_there_no_more_has_no_input(project: Project, gone: Record) -> None:
    own: Any = project
    assert native_inputs(own)(gone) == ""
