"""Bugs in the in-house solvers: the gate at level quick must detect every one."""

from bench.mutation.seeded.bug import Bug

LINE = "vv/engines/dem/line/kernel.py"
LOAD = "vv/engines/dem/terms/dead_loads.py"
PAIRS = "vv/engines/dem/contact/pairs.py"
WALLS = "vv/engines/dem/contact/walls.py"
FRICTION = "vv/engines/dem/contact/friction.py"
ADVANCE = "vv/engines/dem/space/advance.py"
DASHPOTS = "vv/engines/dem/contact/dashpots.py"
NEIGHBOURS = "vv/engines/dem/space/neighbours.py"
BOND_LAW = "vv/engines/dem/bonds/law.py"
BEND = "vv/engines/dem/bonds/block_forces.py"
CRITICAL = "vv/engines/dem/critical_step.py"
DDA = "vv/engines/dda/general/step.py"
DDA_CONTACT = "vv/engines/dda/general/contact.py"
DDA_FORCES = "vv/engines/dda/general/assemble.py"
RIGID_SETTING = "vv/engines/rigid/general/setting.py"
RIGID_EVENTS = "vv/engines/rigid/general/events.py"
RIGID_LANDING = "vv/engines/rigid/general/landing.py"
RIGID_BENDS = "vv/engines/rigid/general/bends.py"

BUGS = (
    Bug('sign of the shear spring', LINE, 'shear - ks * dt', 'shear + ks * dt', 'dem', 'single-contact'),
    Bug('half step missing at the start', LINE, 'start - back * dt / mass', 'start - 0.0', 'dem', 'single-contact'),
    Bug('friction capped on one side', LINE, 'max(trial, -cap), cap)', 'trial, cap)', 'dem', 'single-contact'),
    Bug('cap on the wrong side', LINE, 'min(max(trial, -cap), cap)', 'max(trial, cap)', 'dem', 'single-contact'),
    Bug('contact pulls', LINE, 'load += kn * max(overlap, 0.0)\n                if was', 'load += kn * overlap\n                if was', 'dem', 'single-contact'),
    Bug('drag dropped', LINE, 'decay = (1.0 - lag * rate)', 'decay = (1.0 + 0.0 * rate)', 'dem', 'single-contact'),
    Bug('drag lags in the default scheme', LINE, 'rate = eta * dt / mass', 'rate = eta * dt / mass; lag = 1.0', 'dem', 'single-contact'),
    Bug('dashpots booked twice', DASHPOTS, 'return behind, ahead', 'return 2.0 * behind, 2.0 * ahead', 'dem', 'dashpot'),
    Bug('dashpots pull', DASHPOTS, 'max(by, -kept[k, SPRING] - kept[k, FORCE])', 'by + 0.0', 'dem', 'dashpot'),
    Bug("friction's work not booked", LINE, 'slipped += (trial', 'slipped += 0.0 * (trial', 'dem', 'single-contact'),
    Bug("drag's work not booked", LINE, 'dragged += ahead + drag * before', 'dragged += 0.0', 'dem', 'single-contact'),
    Bug('position moved by the old velocity', LINE, 'q += dt * after', 'q += dt * before', 'dem', 'single-contact'),
    Bug('bodies swapped in a pair', PAIRS, 'at(u, rows[p, 1]), -1.0, at(u, rows[p, 0])', 'at(u, rows[p, 0]), -1.0, at(u, rows[p, 1])', 'dem', 'bounce'),
    Bug('one of a pair not pushed', PAIRS, 'put(push, j, add_scaled(at(push, j), 1.0, force))', 'pass', 'dem', 'bounce'),
    Bug('friction of spheres pulls along', FRICTION, 'slide = add_scaled(NOWHERE, share, add_scaled(relative, -dot(m, relative), m))', 'slide = add_scaled(NOWHERE, -share, add_scaled(relative, -dot(m, relative), m))', 'dem', 'bounce'),
    Bug('gap taken at the start only', WALLS, '-gap[q] - dot(at(facing, q), at(u, rows[q]))', '-gap[q]', 'dem', 'bounce'),
    Bug('stale shear after separation', PAIRS, '                put(shear, p, NOWHERE)', '                pass', 'dem', 'bounce'),
    Bug('shear spring charged twice', FRICTION, "return old, slide, add_scaled(old, -ks, slide)", "return old, slide, add_scaled(old, -2.0 * ks, slide)", 'dem', 'bounce'),
    Bug('no Coulomb cap', FRICTION, 'if dot(trial, trial) <= caps[1] * caps[1]:', 'if True:', 'dem', 'bounce'),
    Bug('dead load dropped', LOAD, 'weight + load)', 'weight)', 'dem', 'bounce:again'),
    Bug('locks ignored', ADVANCE, '    if hold is None:', '    if True:', 'dem', 'bounce'),
    Bug("wrong mass", ADVANCE, "dt / mass[i], free_part(at(force", "dt / (1.01 * mass[i]), free_part(at(force", "dem", "bounce"),
    Bug("wrong mass with drag", ADVANCE, "next_velocity(old, push, mass[i], dt", "next_velocity(old, push, 1.01 * mass[i], dt", "dem", "unlike-bonds:slowed"),
    Bug('wrong lever arm', PAIRS, 'put(turn, j, add_scaled(at(turn, j), radius[p, 1] - 0.5 * overlap, torque))', 'put(turn, j, add_scaled(at(turn, j), radius[p, 1] + 0.5 * overlap, torque))', 'dem', 'bounce'),
    Bug("lever arm of the first of unlike spheres", PAIRS, "put(turn, j, add_scaled(at(turn, j), radius[p, 1] - 0.5 * overlap, torque))", "put(turn, j, add_scaled(at(turn, j), radius[p, 0] - 0.5 * overlap, torque))", "dem", "bounce"),
    Bug("way of roll of the first of unlike spheres", PAIRS, "pairs[3][p, 0] - inside, pairs[3][p, 1] - inside", "pairs[3][p, 0] - inside, pairs[3][p, 0] - inside", "dem", "bounce"),
    Bug("shear lost where neighbours are renewed", NEIGHBOURS, "                put(shear, k, at(old.shear, before))\n", "                pass\n", "dem", "passing"),
    Bug("shear taken from a pair with another partner", NEIGHBOURS, "if old.both[before, 1] == j:", "if old.both[before, 1] >= j:", "dem", "passing"),
    Bug("sign of a bond's twist", BEND, "s = rotated(s, n, twist)", "s = rotated(s, n, -twist)", "dem", "unlike-bonds:spinning"),
    Bug("a bond twists twice as far", BOND_LAW, "twist = 0.5 * dt * dot(add_scaled(a, 1.0, b), middle)", "twist = dt * dot(add_scaled(a, 1.0, b), middle)", "dem", "unlike-bonds:spinning"),
    Bug("lever arms of a bond swapped", BEND, "arm_i, arm_j = arms(radii[0], radii[1], length)", "arm_j, arm_i = arms(radii[0], radii[1], length)", "dem", "unlike-bonds:spinning"),
    Bug("limit with drag alone doubled", CRITICAL, "return 1.0 / n if n > 0.0 else math.inf", "return 2.0 / n if n > 0.0 else math.inf", "dem", "stable-step:viscous", "tests/engines/dem/test_drag_alone.py"),
    Bug("velocity after a cut step", DDA, "work.mass, setting.bodies, part.rule, length", "work.mass, setting.bodies, part.rule, dt", "dda", "failure-modes"),
    Bug("a cut step forgets what contacts were", DDA, "            restore_states(touch, before)\n            length *= 0.5", "            length *= 0.5", "dda", "failure-modes"),
    Bug("shaking taken at the start of a step", DDA, "shake = value(setting.shaking, time + shaken_at * length)", "shake = value(setting.shaking, time)", "dda", "incline:two-directions-turning"),
    Bug("a shear spring in its old plane", DDA_CONTACT, "put(touch.spring, k, rotated_into_plane(at(old.spring, m), n))", "put(touch.spring, k, at(old.spring, m))", "dda", "knife-edge"),
    Bug("a dead load forgotten", DDA_FORCES, "add_scaled(at(bodies.weight, i), 1.0, at(bodies.load, i))", "add_scaled(at(bodies.weight, i), 0.0, at(bodies.load, i))", "dda", "laden-block"),
    Bug("friction pulls along", DDA_FORCES, "pull = add_scaled(pull, -law.mu * force, direction)", "pull = add_scaled(pull, law.mu * force, direction)", "dda", "skid wedge:xi-1"),
    Bug("gyroscopic term dropped", RIGID_SETTING, "FORECASTS if dot(spin, spin) > 0.0 else 1", "1", "rigid", "tumbling spin-stopped responding-block:3d-turning"),
    Bug("moment of momentum kept half", RIGID_SETTING, "put(w, i, times(inverse, i, moment))", "put(w, i, add_scaled(add_scaled(ZERO, 0.5, spin), 0.5, times(inverse, i, moment)))", "rigid", "tumbling knife-edge responding-block:3d-turning rocking"),
    Bug("positions by the velocity at the end", RIGID_EVENTS, "put(state.centre, i, add_scaled(add_scaled(at(state.centre, i), 0.5 * span, at(state.v, i)),\n                                  0.5 * span, v))", "put(state.centre, i, add_scaled(at(state.centre, i), span, v))", "rigid", "knife-edge responding-block:3d-turning"),
    Bug('a landing found in one trial', RIGID_LANDING, 'for _ in range(LANDINGS if there and 0.0 < span < whole else 0):', 'for _ in range(0):', 'rigid', 'tumbling spin-stopped'),
    Bug("friction does not turn within a step", RIGID_BENDS, "turn = bend(before, sag, after, np.sqrt(dot(pulled, pulled)))", "turn = add_scaled(ZERO, 0.0, before)", "rigid", "incline:two-directions-turning"),
    Bug("walls had not moved before t = 0", "vv/engines/dem/terms/moving_walls.py", "    move(term, bodies, motion, -dt, dt)\n", "", "dem", "responding-block shaken-corner", "tests/engines/dem/test_space.py"),
    Bug("a viscous contact half as stiff", "vv/engines/dem/contact/hertz.py", "math.sqrt(mass * 2.0 * modulus * math.sqrt(radius * overlap))", "math.sqrt(mass * modulus * math.sqrt(radius * overlap))", "dem", "restitution", "tests/engines/dem/contact"),
    Bug("Reynolds number of the radius", "vv/engines/dem/terms/fluid.py", "reynolds = fluid.density * across / fluid.viscosity", "reynolds = fluid.density * 0.5 * across / fluid.viscosity", "dem", "mfix:dem06*", "tests/engines/dem"),
    Bug("a pulse that does not end", "vv/engines/kernels/drive.py", "sine = np.sin(angle) if time <= drive.until[k] else 0.0", "sine = np.sin(angle)", "dda", "rocking:stands rocking:topples", "tests/adapters/test_pulses.py"),
    Bug("slip booked at the velocity before the step", "vv/engines/rigid/point/kernel.py", "slid = add_scaled(add_scaled(ZERO, 0.5, u), 0.5, touch.u)", "slid = u", "rigid", "incline", "tests/engines/rigid/test_sliding.py"),
    Bug("a shear spring that does not turn with its plane", FRICTION, "        spring, -dot(n, spring) / (1.0 + dot(n, n_before)), add_scaled(n, 1.0, n_before)\n", "        spring, -dot(n, spring), n\n", "dem", "bounce", "tests/engines/dem/contact"),
)  # fmt: skip
