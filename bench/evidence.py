"""Writes the figures of a benchmark, and exits with 1 if one misses its bar."""

import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def usual(**more: str) -> dict[str, str]:
    """The environment of a user's command, in which Python stores compiled bytecode."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {**kept, **more}


def conclude(name: str, figures: Mapping[str, Any], bars: Mapping[str, bool]) -> None:
    """Print and write bench-NAME.json below .vv/; exit 1 unless every bar holds."""
    document = {"benchmark": name, "figures": dict(figures), "bars": dict(bars)}
    path = Path(".vv") / f"bench-{name}.json"
    path.parent.mkdir(exist_ok=True)
    path.write_text(json.dumps(document, indent=2) + "\n")
    print(json.dumps(document, indent=2))
    sys.exit(0 if all(bars.values()) else 1)
