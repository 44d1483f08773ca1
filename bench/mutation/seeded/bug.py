"""What a seeded bug is."""

from typing import NamedTuple


class Bug(NamedTuple):
    """What is wrong, where, the texts before and after, and who is to see it first.

    code, cases: the gate of that code, asked these cases first; for a bug in a solver or an
    adapter, which the gate must see. tests: files or folders of tests, with spaces between them,
    that are asked where no gate can, or does not, see it.
    """

    what: str
    file: str
    old: str
    new: str
    code: str = ""
    cases: str = ""
    tests: str = ""
