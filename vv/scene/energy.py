"""The forms of energy of a scene, an enum for energy balances and histories."""

import enum


class Form(enum.Enum):
    """One summand of the energy balance [J]; the value is the phrase shown to people.

    Energy that the scene holds or has lost is positive, work done on it is negative, so that the
    sum of all forms is constant in time.
    """

    KINETIC = "kinetic"
    NORMAL = "normal elastic"
    SHEAR = "shear elastic"
    FRICTION = "friction dissipation"
    DRAG = "drag dissipation"  # drag by viscous contacts included
    GRAVITY = "gravity potential"
    LOAD = "load potential"
    SHAKING = "less work of shaking"
    WALLS = "less work of moving walls"
    CARRYING = "less work of carried bodies"
    BROKEN_NORMAL = "breaking dissipation, normal"
    BROKEN_SHEAR = "breaking dissipation, shear"

    @property
    def dissipated(self) -> bool:
        """Whether it is dissipated energy, which can only grow."""
        return self in _HEAT


_HEAT = frozenset((Form.FRICTION, Form.DRAG, Form.BROKEN_NORMAL, Form.BROKEN_SHEAR))


class Loss(enum.Enum):
    """Energy that a method dissipates besides the forms of its scene; it can only grow."""

    NUMERICAL = "numerical dissipation"
    KINETIC_DAMPING = "kinetic damping dissipation"
    IMPACT = "impact dissipation"


DISSIPATED = frozenset(  # the names of these in a balance
    one.value for one in (*(form for form in Form if form.dissipated), *Loss)
)
