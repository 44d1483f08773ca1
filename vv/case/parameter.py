"""The parameters of a case that `--set` may change: name, default, unit and meaning."""

from __future__ import annotations

import enum
import math
import re
from dataclasses import dataclass


class Sign(enum.Enum):
    """The signs that a parameter may have; the value is the rule shown to people."""

    ANY = ""
    NOT_NEGATIVE = "must not be negative"
    POSITIVE = "must be positive"


SIGN_OF_UNIT = {
    **dict.fromkeys(("kg", "kg/m3", "Pa", "Pa s"), Sign.POSITIVE),
    **dict.fromkeys(("N/m", "N s/m", "Hz"), Sign.NOT_NEGATIVE),
}
SYMBOL = "(?:kg|m|s|N|Pa|J|W|Hz|rad|deg|degrees)[2-9]?"
PRODUCT = f"{SYMBOL}(?: {SYMBOL})*"
UNIT = re.compile(f"(?:(?:1|{PRODUCT})/)?{PRODUCT}|")


@dataclass(frozen=True)
class Parameter:
    """A physical parameter that `--set` may change, with its default value in `unit`.

    sign: by default that of its unit: a mass is positive, a stiffness not negative, a length may
    be either. whole: it counts things, and takes whole numbers alone. Raises ValueError for a unit
    that is not made of symbols of UNIT, and for a default that breaks a rule, as a Case does for a
    variant's.
    """

    name: str
    value: float
    unit: str
    meaning: str
    sign: Sign | None = None
    whole: bool = False

    def __post_init__(self) -> None:
        if not UNIT.fullmatch(self.unit):
            raise ValueError(
                f"Parameter {self.name}: unit = {self.unit!r}; it must be made of kg, m, s, N, "
                "Pa, J, W, Hz, rad or deg, such as kg/m3, N s/m or 1/s, or empty for a plain number"
            )
        self.checked(self.value)

    def checked(self, value: float) -> float:
        """The value; raises ValueError with the rule that it breaks: sign, finite or whole."""
        sign = self.sign or SIGN_OF_UNIT.get(self.unit, Sign.ANY)
        wrong = (sign is Sign.POSITIVE and value <= 0) or (sign is Sign.NOT_NEGATIVE and value < 0)
        rule = sign.value if wrong else "" if math.isfinite(value) else "must be finite"
        if not rule and self.whole and not value.is_integer():
            rule = "must be a whole number"
        if rule:
            raise ValueError(f"{self.name} = {value!r} {self.unit}".strip() + f"; it {rule}")
        return value
