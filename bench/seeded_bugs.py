"""The plausible solver bugs that `bench.mutations` seeds: one text replaced by another."""

from typing import NamedTuple


class Bug(NamedTuple):
    """What is wrong, where, the code to ask, and the texts before and after."""

    what: str
    file: str
    code: str
    old: str
    new: str


LINE = "vv/engines/dem/line/kernel.py"
LOAD = "vv/engines/dem/terms/load.py"
PAIRS = "vv/engines/dem/contact/pairs.py"
WALLS = "vv/engines/dem/contact/walls.py"
FRICTION = "vv/engines/dem/contact/friction.py"
ADVANCE = "vv/engines/dem/space/advance.py"
PLAN = "adapters/yade/plan.py"
ENGINES = "adapters/yade/inside/engines.py"
FORCES = "adapters/liggghts/terms/forces.py"
CONTACT = "adapters/liggghts/terms/contact.py"
DASHPOTS = "vv/engines/dem/terms/dashpots.py"

BUGS = (
    Bug("sign of the shear spring", LINE, "dem", "shear - ks * dt", "shear + ks * dt"),
    Bug("half step missing at the start", LINE, "dem", "start - back * dt / mass", "start - 0.0"),
    Bug("friction capped on one side", LINE, "dem", "max(trial, -cap), cap)", "trial, cap)"),
    Bug("cap on the wrong side", LINE, "dem", "min(max(trial, -cap), cap)", "max(trial, cap)"),
    Bug("contact pulls", LINE, "dem", "load += kn * max(overlap, 0.0)\n                if was", "load += kn * overlap\n                if was"),
    Bug("drag dropped", LINE, "dem", "decay = (1.0 - lag * rate)", "decay = (1.0 + 0.0 * rate)"),
    Bug("drag lags in the default scheme", LINE, "dem", "rate = eta * dt / mass", "rate = eta * dt / mass; lag = 1.0"),
    Bug("dashpots booked twice", DASHPOTS, "dem", "return behind, ahead", "return 2.0 * behind, 2.0 * ahead"),
    Bug("dashpots pull", DASHPOTS, "dem", "max(by, -kept[k, SPRING] - kept[k, FORCE])", "by + 0.0"),
    Bug("friction's work not booked", LINE, "dem", "slipped += (trial", "slipped += 0.0 * (trial"),
    Bug("drag's work not booked", LINE, "dem", "dragged += ahead + drag * before", "dragged += 0.0"),
    Bug("position moved by the old velocity", LINE, "dem", "q += dt * after", "q += dt * before"),
    Bug("bodies swapped in a pair", PAIRS, "dem", "at(u, rows[p, 1]), -1.0, at(u, rows[p, 0])", "at(u, rows[p, 0]), -1.0, at(u, rows[p, 1])"),
    Bug("one of a pair not pushed", PAIRS, "dem", "put(push, j, plus(at(push, j), 1.0, force))", "pass"),
    Bug("friction pulls along", FRICTION, "dem", "slide = plus(NOWHERE, share, plus(relative, -dot(m, relative), m))", "slide = plus(NOWHERE, -share, plus(relative, -dot(m, relative), m))"),
    Bug("gap taken at the start only", WALLS, "dem", "-gap[q] - dot(at(facing, q), at(u, rows[q]))", "-gap[q]"),
    Bug("stale shear after separation", PAIRS, "dem", "                put(shear, p, NOWHERE)", "                pass"),
    Bug("shear spring charged twice", FRICTION, "dem", "trial = plus(old, -ks, slide)", "trial = plus(old, -2.0 * ks, slide)"),
    Bug("no Coulomb cap", FRICTION, "dem", "if dot(trial, trial) <= caps[1] * caps[1]:", "if True:"),
    Bug("dead load dropped", LOAD, "dem", "return plus(push, 1.0, at(term.load, i))", "return push"),
    Bug("locks ignored", ADVANCE, "dem", "    if hold is None:", "    if True:"),
    Bug("wrong mass", ADVANCE, "dem", "carried_on(old, push, mass[i], dt", "carried_on(old, push, 1.01 * mass[i], dt"),
    Bug("wrong lever arm", PAIRS, "dem", "put(turn, j, plus(at(turn, j), radius[p, 1] - 0.5 * overlap, torque))", "put(turn, j, plus(at(turn, j), radius[p, 1] + 0.5 * overlap, torque))"),
    Bug("velocity not set back half a step", PLAN, "yade", "* (dt / 2)", "* 0.0"),
    Bug("push at the start forgotten", PLAN, "yade", "(given.mass[:, None] / dt - scene.eta) * early", "0.0 * early"),
    Bug("ratcheting correction left on", ENGINES, "yade", "noRatch=False", "noRatch=True"),
    Bug("numerical damping left on", ENGINES, "yade", "NewtonIntegrator(damping=0,", "NewtonIntegrator(damping=0.2,"),
    Bug("drag forgotten in the deck", FORCES, "liggghts", 'f"fix drag all viscous {float(setup.scene.eta)!r}"', '""'),
    Bug("shear spring as stiff as the normal one", CONTACT, "liggghts", '"kt": contact.ks', '"kt": contact.kn'),
)  # fmt: skip
