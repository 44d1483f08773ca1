"""The files that a documentation page shows in full, so that a test can write them."""

import re
from pathlib import Path

from tests import ROOT

SHOWN = re.compile(r"`([\w/]+\.py)`:\n\n```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def shown(page: str) -> dict[str, str]:
    """Path -> text of every Python file that is named right before its block in a page."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    return dict(SHOWN.findall(text))


def write(root: Path, files: dict[str, str]) -> None:
    """Put the files below a folder; none of them may be there already."""
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("x") as file:
            file.write(text)
