"""Checks the first motion of a block on an incline in `rigid` against the published chart.

`python -m bench.speed.failure_modes` solves 400 points, in the plane and in space; `--seed` and
`--points` choose others. The bar: every answer agrees with the chart.
"""

import argparse
from collections import Counter

from bench.evidence import conclude
from tests.scenes.blocks.failure_modes import NEAR, charted, points, seen


def main() -> None:
    """Solve all points, count the agreements and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=2016)
    parser.add_argument("--points", type=int, default=400)
    options = parser.parse_args()
    chosen = list(points(options.points, options.seed))
    figures = {
        "seed": options.seed,
        "points": len(chosen),
        "left out, nearer to a border than [rad]": NEAR,
        "modes": Counter(charted(*point)[0] for point in chosen),
    }
    bars = {}
    for name, plane in (("in the plane", True), ("in space", False)):
        answers = [(point, charted(*point)[0], seen(*point, plane)) for point in chosen]
        wrong = [answer for answer in answers if answer[1] != answer[2]]
        figures[f"wrong {name}: (alpha, phi, delta), chart, seen"] = wrong
        bars[f"every first motion {name} is the chart's"] = not wrong
    conclude("failure-modes", figures, bars)


if __name__ == "__main__":
    main()
