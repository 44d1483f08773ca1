"""A setting that is none of the case is judged by its bound as it is derived, above 0.1 too."""

import json

import pytest

from tests.conftest import Tiny

OWN = ("0.1", 0.1, "pass")  # a setting of the case, where the bound is 0.12 and is cut


@pytest.mark.parametrize(
    ("dt", "allowed", "verdict"), [OWN, ("0.2", 0.48, "pass"), ("0.5", None, "no-reference")]
)
def test_a_bound_is_cut_at_the_settings_of_the_case_alone(
    tiny: Tiny, dt: str, allowed: float | None, verdict: str
) -> None:
    tiny.edit("cases/fall.py", "Tolerance(1e-3, ", "Tolerance(0.12, reason=")
    tiny.edit("cases/fall.py", "dt=0.1, order=1)", "dt=0.1, order=2)")
    tiny.vv("run", "fall:up", "--codes", "fake/good", "--rung", f"dt={dt}", "--json", "out.json")
    (record,) = json.loads((tiny.root / "out.json").read_text())["records"]
    found = {one["name"]: one for one in record["quantities"]}["y"]
    assert (found["tolerance"], found["verdict"]) == (pytest.approx(allowed), verdict)


def test_a_setting_named_by_twelve_digits_is_that_of_the_case(tiny: Tiny) -> None:
    """Commands that run a finding again name settings so."""
    tiny.edit("cases/fall.py", "Knobs(dt=0.05)", "Knobs(dt=0.1 / 3)")
    for given, taken in (("0.0333333333333", 0.1 / 3), ("0.033333333", 0.033333333)):
        tiny.vv(
            "run", "fall:up", "--codes", "fake/good", "--rung", f"dt={given}", "--json", "o.json"
        )
        (record,) = json.loads((tiny.root / "o.json").read_text())["records"]
        assert record["rung"]["dt"] == taken
