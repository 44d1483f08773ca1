"""The forms of energy of a whole scene: a closed list, of which balances and histories are made."""

import enum


class Form(enum.Enum):
    """A term of the balance of energy [J]; the value is the phrase shown to people.

    What a scene holds or has lost counts as positive, work done on it as negative: the sum of all
    forms does not change.
    """

    KINETIC = "kinetic"
    NORMAL = "normal elastic"
    SHEAR = "shear elastic"
    FRICTION = "friction dissipation"
    DRAG = "drag dissipation"  # by viscous contacts, too
    GRAVITY = "gravity potential"
    LOAD = "load potential"
    SHAKING = "less work of shaking"
    WALLS = "less work of moving walls"
    CARRYING = "less work of carried bodies"
    BROKEN_NORMAL = "breaking dissipation, normal"
    BROKEN_SHEAR = "breaking dissipation, shear"
