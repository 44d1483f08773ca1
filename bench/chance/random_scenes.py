"""Runs random scenes in every scheme of the in-house codes; counts crashes and broken laws.

`python -m bench.chance.random_scenes [KIND] [NUMBER] [SEED]` draws NUMBER scenes of spheres, blocks
or slopes, as the tests of random scenes do with a few, and runs each in every scheme. No scheme may
crash, and schemes that promise to obey the conservation laws may not violate one. The penetration
of contacts is not judged, since it is part of the random scene.
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
}  # kind of scene -> function that draws it, duration [s], step [s]
OURS: tuple[Adapter, ...] = (
    adapters.exact.ADAPTER, adapters.dem.ADAPTER, adapters.rigid.ADAPTER, adapters.dda.ADAPTER
)  # fmt: skip
KN = 1e8  # N/m
BREAKS = {"dda/lagged"}  # its friction lags by one iteration, and may act along the slip


def problems(
    adapter: Adapter, scheme: str, scene: Scene, duration: float, dt: float
) -> Iterator[str]:
    """The status of a scene in a scheme, and the laws that are violated."""
    try:
        run = answer(adapter, asked(scene, duration, dt, KN), scheme)
    except Exception as error:  # a crash is counted, and the other scenes go on
        yield f"crashed: {error!r}"
        return
    yield run.status.value if run.status in ENDS else f"{run.status.value}: {run.reason}"
    for law, size, allowed in breaches(run.ledger):
        if not law.startswith("penetration"):
            yield f"broke: {law}"
            print(f"{adapter.name}/{scheme}: {law} {size:.3g}, allowed {allowed:.3g}", flush=True)


def main(kind: str = "blocks", number: str = "200", first: str = "1") -> None:
    """Draw scenes, run them, count the results and judge."""
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
