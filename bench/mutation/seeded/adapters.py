"""Bugs in the translation of scenes for external codes, and in the reading of answers."""

from bench.mutation.seeded.bug import Bug

PLAN = "adapters/yade/plan.py"
ENGINES = "adapters/yade/inside/engines.py"
STEPPING = "adapters/yade/inside/stepping.py"
BODIES = "adapters/yade/inside/bodies.py"
YADE_BONDS = "adapters/yade/terms/bonds.py"
YADE_DRIVES = "adapters/yade/terms/drives.py"
YADE_CONTACT = "adapters/yade/terms/contact.py"
FORCES = "adapters/liggghts/terms/forces.py"
CONTACT = "adapters/liggghts/terms/contact.py"
BONDS = "adapters/liggghts/terms/bonds.py"
DRIVES = "adapters/liggghts/terms/drives.py"
SETUP = "adapters/liggghts/setup.py"
CLUMPS = "adapters/liggghts/clumps.py"

BUGS = (
    Bug('velocity not set back half a step', PLAN, '* (dt / 2)', '* 0.0', 'yade', 'single-contact'),
    Bug('push at the start forgotten', PLAN, '(given.mass[:, None] / dt - scene.eta) * early', '0.0 * early', 'yade', 'single-contact'),
    Bug('ratcheting correction left on', ENGINES, 'noRatch=False', 'noRatch=True', 'yade', 'single-contact'),
    Bug('numerical damping left on', ENGINES, 'NewtonIntegrator(damping=0,', 'NewtonIntegrator(damping=0.2,', 'yade', 'single-contact'),
    Bug('drag forgotten in the deck', FORCES, 'f"fix drag all viscous {float(setup.scene.eta)!r}"', '""', 'liggghts', 'single-contact'),
    Bug('shear spring as stiff as the normal one', CONTACT, '"kt": contact.ks', '"kt": contact.kn', 'liggghts', 'bounce skid'),
    Bug("reactions without the weight", STEPPING, "[-force - mass * g for", "[-force + 0.0 * mass * g for", "yade", "unlike-bonds:hung"),
    Bug("the spring on a wall charged the other way", BODIES, "contact.phys.shearForce = force", "contact.phys.shearForce = [-part for part in force]", "yade", "incline:gravity-10 at-yield"),
    Bug("one radius for all drag", ENGINES, "(6 * math.pi * radius)", '(6 * math.pi * max(moving(ask, "radius")))', "yade", "unlike-bonds:slowed"),
    Bug("phase of shaking forgotten", ENGINES, 'fi=[sine["fi"]] * 3, ids=ids', "fi=[0.0] * 3, ids=ids", "yade", "incline shaken-corner"),
    Bug("a wall half a step late", YADE_DRIVES, '+ np.pi * sine["f"] * dt', "", "yade", "shaken-corner responding-block"),
    Bug("a bond as long as its radii", YADE_BONDS, '"overlap": reach - scene.bonds.length', '"overlap": 0.0 * reach', "yade", "unlike-bonds:row"),
    Bug("every bond as stiff across as along", YADE_BONDS, '"ks": scene.bonds.ks', '"ks": scene.bonds.kn', "yade", "unlike-bonds:spinning"),
    Bug("dashpots forgotten in the first half step", YADE_CONTACT, "force = initial_viscous_forces(setup.scene)", "force = 0.0 * initial_viscous_forces(setup.scene)", "yade", "dashpot"),
    Bug("velocities half a step early", STEPPING, "[(early + late) / 2 for", "[early for", "yade", "bounce resting"),
    Bug("kinds of bonds swapped where they differ", BONDS, "{b + 1} {kind + 1} {i + 1}", "{b + 1} {len(kinds) - kind} {i + 1}", "liggghts", "unlike-bonds:row"),
    Bug("a bond twice as stiff", BONDS, "{kn / 2!r} {length!r}", "{kn!r} {length!r}", "liggghts", "long-swing:bonded stability-map:unit"),
    Bug("the way of a moving wall forgotten", DRIVES, "zip(AXES, (scale * along).tolist(), strict=True)", "zip(AXES, (scale * np.abs(along)).tolist(), strict=True)", "liggghts", "shaken-corner responding-block"),
    Bug("a wall by its velocity at the end", DRIVES, '"cos", f"(step-0.5)*{dt!r}"', '"cos", f"step*{dt!r}"', "liggghts", "shaken-corner responding-block"),
    Bug("one mass for all shaking", DRIVES, "_force(name, setup.scene.wave, mass,", "_force(name, setup.scene.wave, min(setup.shaken)[0],", "liggghts", "incline shaken-corner"),
    Bug("a dead load reversed", FORCES, "addforce {numbers(load)}", "addforce {numbers([-part for part in load])}", "liggghts", "bounce:again"),
    Bug("weight of the raised mass", SETUP, "load=g.load + g.mass[:, None] * scene.gravity", "load=g.load + (g.mass + extra)[:, None] * scene.gravity", "liggghts", "settling"),
    Bug("every corner as stiff as the block", CLUMPS, "kn=scene.contact.kn / count", "kn=scene.contact.kn", "liggghts", "incline"),
    Bug("the spring charged the wrong way", SETUP, "{i: -row / ks for i, row", "{i: row / ks for i, row", "liggghts", "incline"),
    Bug("answers turned the wrong way", "adapters/yade/answers.py", "values @ setup.frame, strict", "values @ setup.frame.T, strict", tests="tests/adapters/yade/test_answers.py"),
    Bug("velocities begin at nil", "adapters/liggghts/answers.py", "np.zeros(3) if isinstance(o, Displacement) else speeds[i]", "np.zeros(3)", tests="tests/adapters/liggghts/test_answers.py"),
    Bug("spins of the first that are listed", "adapters/liggghts/atoms.py", "for row, vector in zip(given.tolist(), rows[given].tolist(), strict=True):", "for row, vector in enumerate(rows[given].tolist()):", tests="tests/adapters/liggghts/test_deck.py"),
    Bug("a program told that blocks turn where they move", "vv/codes/program/question.py", '"free_spin": block.free_spin', '"free_spin": block.free', tests="tests/codes/program/test_question.py"),
    Bug("a program's largest energy taken for its remainder", "vv/codes/program/result.py", 'parts["unaccounted"].size(), parts["peak"].size()', 'parts["peak"].size(), parts["unaccounted"].size()', tests="tests/codes/program/test_result.py"),
    Bug("the energy that a program promises to keep unjudged", "vv/codes/program/result.py", 'parts["peak"].size(), bound)', 'parts["peak"].size())', tests="tests/codes/program/test_result.py"),
    Bug("spins of Kratos that are velocities", "adapters/kratos/plan.py", '"spin": spheres.spin,', '"spin": spheres.velocity,', tests="tests/adapters/kratos/test_plan.py"),
    Bug("blocks as boxes turn where they move", "vv/standins/boxed.py", '"free_spin": block.free_spin', '"free_spin": block.free', tests="tests/standins/test_boxed.py"),
)  # fmt: skip
