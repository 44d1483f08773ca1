"""Scenes at random in every scheme of the in-house codes: how they end, and which laws they break.

`python -m bench.chance.random_scenes [KIND] [NUMBER] [SEED]` draws so many scenes of spheres,
blocks or slopes, as the tests of random scenes do with a few, and puts each to every scheme. No
one may crash, and of the schemes that promise to keep to the laws none may break one. A depth of
contact is left out: the scenes draw it, and no code.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator

from hypothesis import HealthCheck, given, seed, settings
from hypothesis.strategies import SearchStrategy

import adapters.dda
import adapters.dem
import adapters.exact
import adapters.rigid
from bench.evidence import conclude
from tests.adapters.test_random_scenes import ENDS, answer, asked
from tests.scenes.random_scenes import any_blocks, any_spheres, slopes
from vv.codes import Adapter
from vv.gate.judgement import breaches
from vv.scene import Scene

KINDS: dict[str, tuple[SearchStrategy[Scene], float, float]] = {
    "spheres": (any_spheres(), 0.05, 1e-4),
    "blocks": (any_blocks(), 0.2, 2.5e-3),
    "slopes": (slopes(), 0.4, 1e-3),
}  # what is drawn, for how long it is asked [s], in steps of [s]
OURS: tuple[Adapter, ...] = (
    adapters.exact.ADAPTER, adapters.dem.ADAPTER, adapters.rigid.ADAPTER, adapters.dda.ADAPTER
)  # fmt: skip
KN = 1e8  # N/m
BREAKS = {"dda/lagged"}  # its friction is one iteration late, and may act along the slip


def problems(
    adapter: Adapter, scheme: str, scene: Scene, duration: float, dt: float
) -> Iterator[str]:
    """How a scene ends in a scheme, and the laws that it breaks there."""
    try:
        run = answer(adapter, asked(scene, duration, dt, KN), scheme)
    except Exception as error:  # what crashes is counted here, and the rest goes on
        yield f"crashed: {error!r}"
        return
    yield run.status.value if run.status in ENDS else f"{run.status.value}: {run.reason}"
    for law, size, allowed in breaches(run.ledger):
        if not law.startswith("penetration"):
            yield f"broke: {law}"
            print(f"{adapter.name}/{scheme}: {law} {size:.3g}, allowed {allowed:.3g}", flush=True)


def main(kind: str = "blocks", number: str = "200", first: str = "1") -> None:
    """Draw, ask, count and judge."""
    scenes, duration, dt = KINDS[kind]
    count: Counter[str] = Counter()

    @seed(int(first))
    @settings(max_examples=int(number), deadline=None, database=None,
              suppress_health_check=list(HealthCheck))  # fmt: skip
    @given(scenes)
    def ask_all(scene: Scene) -> None:
        for adapter in OURS:
            for scheme in adapter.schemes:
                label = f"{adapter.name}/{scheme.name}"
                count.update(
                    f"{label} {one}" for one in problems(adapter, scheme.name, scene, duration, dt)
                )

    ask_all()
    broke = {one.split()[0] for one in count if " broke: " in one} - BREAKS
    ended = {
        f"{scheme} {end.value}" for scheme in {one.split()[0] for one in count} for end in ENDS
    }
    lost = [one for one in count if " broke: " not in one and one not in ended]
    conclude(
        "random_scenes",
        {"kind": kind, "scenes": int(number), **dict(sorted(count.items()))},
        {"none crashed": not lost, "laws were kept": not broke},
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
