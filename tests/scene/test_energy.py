"""Which terms of a balance of energy are heat: all that codes book under such a name."""

import re

from tests import ROOT
from vv.scene import DISSIPATED, Form


def test_what_is_called_dissipation_is_known_to_be_dissipated() -> None:
    sources = [*ROOT.glob("vv/engines/**/*.py"), *ROOT.glob("adapters/**/*.py")]
    named = {
        name
        for path in sources
        for name in re.findall(r'"([a-z ]*dissipation[a-z ,]*)"', path.read_text())
    }
    assert {"friction dissipation", "numerical dissipation"} <= named
    assert named <= DISSIPATED


def test_no_form_that_can_shrink_is_heat() -> None:
    held = {form for form in Form if not form.dissipated}
    assert {Form.KINETIC, Form.NORMAL, Form.GRAVITY, Form.SHAKING} <= held
    assert {form for form in Form if "dissipation" in form.value}.isdisjoint(held)
