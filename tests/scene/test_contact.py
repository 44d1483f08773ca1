"""What a contact law says of itself, and what it refuses, one row a decision."""

from typing import Any

import numpy as np
import pytest

from vv.scene import Contact, Hertz


@pytest.mark.parametrize("name", ["ks", "mu", "eta_n"])
@pytest.mark.parametrize("value", [-1.0, np.inf, np.nan])
def test_a_value_out_of_range_is_named(name: str, value: float) -> None:
    given: dict[str, Any] = {name: value}
    with pytest.raises(ValueError, match=rf"Contact\.{name} = "):
        Contact(1e3, **given)


@pytest.mark.parametrize("kn", [0.0, -1.0, np.nan])
def test_a_stiffness_is_positive(kn: float) -> None:
    with pytest.raises(ValueError, match=r"Contact\.kn = "):
        Contact(kn)


def test_rigid_contact_is_not_viscous() -> None:
    with pytest.raises(ValueError, match="viscous contact has a finite kn"):
        Contact(np.inf, eta_n=1.0)


@pytest.mark.parametrize(
    ("law", "rigid", "viscous", "shear"),
    [
        (Contact(1e3), False, False, False),
        (Contact(1e3, 1e2), False, False, False),
        (Contact(1e3, 0.0, 0.5), False, False, False),
        (Contact(1e3, 1e2, 0.5), False, False, True),
        (Contact(1e3, eta_n=1.0), False, True, False),
        (Contact(np.inf), True, False, False),
        (Contact(np.inf, mu=0.5), True, False, True),
        (Contact(0.0, mu=0.5, hertz=Hertz(1e9)), False, False, False),
        (Contact(0.0, mu=0.5, hertz=Hertz(1e9, 4e8)), False, False, True),
        (Contact(0.0, hertz=Hertz(1e9, 4e8, 0.1)), False, True, False),
    ],
)
def test_a_law_is_rigid_viscous_and_rough_or_not(
    law: Contact, rigid: bool, viscous: bool, shear: bool
) -> None:
    assert (law.rigid, law.viscous, law.carries_shear) == (rigid, viscous, shear)
