"""Claims about a new term of dem, written by following docs/extending.md."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests import ROOT
from tests.support.written_pages import shown, write

TERM = "vv/engines/dem/terms/stiffening.py"
EDITS = {
    "vv/engines/dem/terms/every.py": [
        ("    wall_contacts,\n)", "    wall_contacts,\n    stiffening,\n)"),
        ("    wall_contacts,\n    near", "    wall_contacts,\n    stiffening,\n    near"),
    ],
    "vv/scene/contact.py": [
        ("    eta_n: float = 0.0\n", "    eta_n: float = 0.0\n    kh: float = 0.0\n"),
        ('("eta_n", " N s/m")', '("eta_n", " N s/m"), ("kh", " N/m^1.5")'),
    ],
    "vv/scene/terms.py": [
        ('    BOND = "', '    STIFFENING = "contact that stiffens"\n    BOND = "'),
    ],
    "vv/scene/scene.py": [
        ("{\n            Term.SPHERE: ", "{\n            Term.STIFFENING: self.contact.kh > 0,\n"
         "            Term.SPHERE: "),
    ],
    "adapters/dem.py": [("        Term.DRAG,\n", "        Term.DRAG,\n        Term.STIFFENING,\n")],
}  # fmt: skip
SOLVE = """
import json
import numpy as np
from adapters import dem, exact
from vv.ask import Ask, Displacement, History, Knobs, Velocity
from vv.codes import unsupported
from vv.engines.dem import CENTRED, critical_step
from vv.scene import Contact, Scene, Spheres, Wall
M, V, KN, KH = 2.0, 0.3, 1e3, 1e7
up, one = np.array([0.0, 0.0, 1.0]), np.ones(1)
ball = Spheres(up[None] * 0.5, -V * up[None], 0.5 * one, M * one, np.array([[False, False, True]]))
found = []
for dt in (4e-5, 2e-5, 1e-5):
    scene = Scene((Wall(0 * up, up), ball), Contact(KN, kh=KH))
    ask = Ask(scene, History(4e-2, dt), (Displacement(1), Velocity(1)), Knobs(dt))
    (run,) = dem.ADAPTER.run([ask], "default", None, 0.0)
    depth, speed = -run.values[Displacement(1)][:, 2].min(), run.values[Velocity(1)][-1, 2]
    found.append([0.5 * KN * depth**2 + 0.4 * KH * depth**2.5, speed, run.ledger.unaccounted])
print(json.dumps({
    "found": found, "energy": 0.5 * M * V**2, "speed": V, "steps": run.status.value,
    "modelled": sorted(term.value for term in run.model.terms),
    "others": sorted(t.value for t in unsupported(exact.ADAPTER.schemes[0], scene.terms())),
    "limit": critical_step(scene, CENTRED), "linear": 2 / (KN / M) ** 0.5,
}))
"""


@pytest.fixture(scope="module")
def answer(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    """The answer of a copy of this project with the new term and no other edits."""
    root = tmp_path_factory.mktemp("copy")
    for name in ("adapters", "vv"):
        shutil.copytree(ROOT / name, root / name, ignore=shutil.ignore_patterns("__pycache__"))
    write(root, {TERM: shown("extending.md")[TERM]})
    for name, edits in EDITS.items():
        edit(root / name, edits)
    env = {**os.environ, "PYTHONPATH": str(root), "VV_CACHE": str(root / "kernels")}
    done = subprocess.run(
        [sys.executable, "-c", SOLVE],
        cwd=root,
        env=env,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    told: dict[str, object] = json.loads(done.stdout)
    return told


def edit(path: Path, edits: list[tuple[str, str]]) -> None:
    """Replace text that occurs exactly once."""
    text = path.read_text()
    for old, new in edits:
        assert text.count(old) == 1, (path, old)
        text = text.replace(old, new)
    path.write_text(text)


def test_in_the_engine_it_is_one_file_and_its_name_in_the_list() -> None:
    assert [name for name in EDITS if name.startswith("vv/engines")] == [
        "vv/engines/dem/terms/every.py"
    ]


def test_its_force_energy_and_step_are_used(answer: dict[str, object]) -> None:
    found, energy, speed = answer["found"], answer["energy"], answer["speed"]
    assert isinstance(found, list)
    assert isinstance(energy, float)
    off = [abs(held / energy - 1) for held, _, _ in found]
    assert off[-1] < 1e-5
    assert all(abs(back / speed - 1) < 1e-4 for _, back, _ in found)
    unaccounted = [lost / energy for _, _, lost in found]
    assert unaccounted[0] / unaccounted[-1] > 12  # of second order: 16
    assert answer["limit"] < 0.5 * answer["linear"]  # type: ignore[operator]


def test_it_is_said_to_be_modelled_and_other_codes_lack_it(answer: dict[str, object]) -> None:
    assert "contact that stiffens" in answer["modelled"]  # type: ignore[operator]
    assert answer["others"] == ["contact that stiffens"]
