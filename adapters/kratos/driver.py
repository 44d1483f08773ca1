"""Solves an ask with Kratos' DEM application: spheres on springs or by Hertz, velocity Verlet.

The input is what `adapters.kratos.plan` writes. Kratos derives masses from densities; here each
sphere then gets its mass and inertia, and its weight and loads as one force. The solver is called
step by step, without the other parts of Kratos' analysis stage. The force at t = 0 is set
explicitly, since the first half step would otherwise have none.
"""

import json
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")  # read when Kratos is imported
import KratosMultiphysics as Kratos
import KratosMultiphysics.DEMApplication as Dem
import numpy as np
from KratosMultiphysics.DEMApplication.DEM_analysis_stage import DEMAnalysisStage

from vv.codes.driver_protocol import Plan, Stopwatch, serve

FILE = "spheres"  # the name of Kratos' input files in its working folder
FACE = 1_000_000  # numbers of the nodes of walls begin there
AXES = "XYZ"
SPRINGS, HERTZ = "DEM_D_Linear_Custom_Constants", "DEM_D_Hertz_viscous_Coulomb"
Kratos.Logger.GetDefaultOutput().SetSeverity(Kratos.Logger.Severity.WARNING)


def simulate(ask: Plan, watched: bool, watch: Stopwatch) -> tuple[object, Plan]:
    """Build the scene and take all steps; values are displacements or velocities (.., time, 3)."""
    write_input(ask)
    stage = DEMAnalysisStage(Kratos.Model(), Kratos.Parameters(json.dumps(settings(ask))))
    stage.Initialize()
    part, solver = stage.spheres_model_part, stage._GetSolver()
    nodes = [part.Nodes[number] for number in range(1, len(ask["spheres"]) + 1)]
    for node, sphere in zip(nodes, ask["spheres"], strict=True):
        start(node, sphere, turning(ask))
    seen = [(kind == "velocity", nodes[sphere]) for kind, sphere in ask["observe"]]
    origin = [np.array(ask["spheres"][sphere]["position"]) for _, sphere in ask["observe"]]
    values = np.zeros((len(seen), ask["steps"] // ask["stride"] + 1, 3))
    for number, (_, sphere) in enumerate(ask["observe"]):
        values[number, 0] = ask["spheres"][sphere]["velocity"] if seen[number][0] else 0.0
    watch.lap("setup")
    now = 0.0
    for column in range(1, values.shape[1]):
        for _ in range(ask["stride"]):
            now = solver.AdvanceInTime(now)
            solver.InitializeSolutionStep()
            solver.SolveSolutionStep()
            solver.FinalizeSolutionStep()
        watch.lap("steps")
        if watched:
            for number, (fast, node) in enumerate(seen):
                values[number, column] = (
                    node.GetSolutionStepValue(Kratos.VELOCITY)
                    if fast
                    else np.subtract((node.X, node.Y, node.Z), origin[number])
                )
            watch.lap("reading")
    stage.Finalize()
    watch.lap("reading")
    return values, {}


def turning(ask: Plan) -> bool:
    """Whether any sphere may rotate; if none may, Kratos does not integrate rotation."""
    return any(any(sphere["free_spin"]) for sphere in ask["spheres"])


def start(node: Kratos.Node, sphere: Plan, turns: bool) -> None:
    """Set a sphere's mass, motion, locks and forces."""
    node.SetSolutionStepValue(Kratos.NODAL_MASS, sphere["mass"])
    motion = [("VELOCITY", sphere["velocity"], sphere["free"])]
    if turns:
        node.SetSolutionStepValue(Dem.PARTICLE_MOMENT_OF_INERTIA, sphere["inertia"])
        motion.append(("ANGULAR_VELOCITY", sphere["spin"], sphere["free_spin"]))
    for name, value, free in motion:
        node.SetSolutionStepValue(getattr(Kratos, name), Kratos.Array3(value))
        for axis, loose in zip(AXES, free, strict=True):
            if not loose:
                node.Fix(getattr(Kratos, f"{name}_{axis}"))
    node.SetSolutionStepValue(Kratos.EXTERNAL_APPLIED_FORCE, Kratos.Array3(sphere["force"]))
    node.SetSolutionStepValue(Kratos.TOTAL_FORCES, Kratos.Array3(sphere["start"]))


def settings(ask: Plan) -> Plan:
    """The parameters of Kratos' analysis."""
    reach = 0.1 * min(sphere["radius"] for sphere in ask["spheres"])
    return {
        "Dimension": 3,
        "PeriodicDomainOption": False,
        "BoundingBoxOption": False,
        "AutomaticBoundingBoxOption": False,
        "dem_inlet_option": False,
        "GravityX": 0.0,
        "GravityY": 0.0,
        "GravityZ": 0.0,
        "RotationOption": turning(ask),
        "CleanIndentationsOption": False,
        "solver_settings": {
            "RemoveBallsInitiallyTouchingWalls": False,
            "strategy": "sphere_strategy",
            "material_import_settings": {"materials_filename": f"{FILE}.json"},
        },
        "VirtualMassCoefficient": 1.0,
        "RollingFrictionOption": False,
        "GlobalDamping": 0.0,
        "ContactMeshOption": False,
        "OutputFileType": "Ascii",
        "Multifile": "single_file",
        "ElementType": "SphericPartDEMElement3D",
        "TranslationalIntegrationScheme": "Velocity_Verlet",
        "RotationalIntegrationScheme": "Direct_Integration",
        "MaxTimeStep": ask["dt"],
        "FinalTime": (ask["steps"] + 1) * ask["dt"],
        "NeighbourSearchFrequency": 1,
        "SearchTolerance": reach,
        "search_tolerance_against_walls": reach,
        "GraphExportFreq": 1e9,
        "VelTrapGraphExportFreq": 1e9,
        "OutputTimeStep": 1e9,
        "PostBoundingBox": False,
        "post_vtk_option": False,
        "problem_name": FILE,
    }


def write_input(ask: Plan) -> None:
    """Write the files that Kratos reads: materials, spheres, walls, and empty ones."""
    text = {
        f"{FILE}.json": json.dumps(materials(ask)),
        f"{FILE}DEM.mdpa": spheres(ask["spheres"]),
        f"{FILE}DEM_FEM_boundary.mdpa": walls(ask["walls"]),
    }
    for other in ("Clusters", "DEM_Inlet", "DEM_Clusters"):
        text[f"{FILE}{other}.mdpa"] = ""
    for name, body in text.items():
        with open(name, "w") as file:
            file.write(body if name.endswith("json") else mdpa(body))


def materials(ask: Plan) -> Plan:
    """One material for spheres and one for walls; stiffnesses are properties of their contacts.

    Where the scene has elastic spheres instead of springs, both get the same elastic constants,
    from which Kratos derives the contacts.
    """
    elastic = "young" in ask["law"]
    young, poisson = ask["law"].get("young", 1e9), ask["law"].get("poisson", 0.2)
    sphere = {"PARTICLE_DENSITY": 1000.0, "YOUNG_MODULUS": young, "POISSON_RATIO": poisson}
    stiff = young if elastic else 1e20
    wall = {"YOUNG_MODULUS": stiff, "POISSON_RATIO": poisson, "COMPUTE_WEAR": False}
    springs = {} if elastic else {"K_NORMAL": ask["law"]["kn"], "K_TANGENTIAL": ask["law"]["ks"]}
    law = contact_law(ask["mu"], elastic) | springs
    return {
        "materials": [
            {"material_name": "sphere", "material_id": 1, "Variables": sphere | springs},
            {"material_name": "wall", "material_id": 2, "Variables": wall},
        ],
        "material_relations": [
            {
                "material_names_list": ["sphere", other],
                "material_ids_list": [1, number],
                "Variables": law,
            }
            for number, other in enumerate(("sphere", "wall"), 1)
        ],
        "material_assignation_table": [["SpheresPart", "sphere"], ["RigidFacePart", "wall"]],
    }


def contact_law(mu: float, elastic: bool) -> Plan:
    """A contact with friction mu and these springs, without losses, rolling resistance and wear."""
    return {
        "DEM_DISCONTINUUM_CONSTITUTIVE_LAW_NAME": HERTZ if elastic else SPRINGS,
        "DEM_ROLLING_FRICTION_MODEL_NAME": "DEMRollingFrictionModelConstantTorque",
        "STATIC_FRICTION": mu,
        "DYNAMIC_FRICTION": mu,
        "FRICTION_DECAY": 500.0,
        "COEFFICIENT_OF_RESTITUTION": 1.0,
        "DAMPING_GAMMA": 0.0,
        "ROLLING_FRICTION": 0.0,
        "ROLLING_FRICTION_WITH_WALLS": 0.0,
        "SEVERITY_OF_WEAR": 0.0,
        "IMPACT_WEAR_SEVERITY": 0.0,
        "BRINELL_HARDNESS": 1.0,
    }


def mdpa(body: str) -> str:
    """A model part in Kratos' own file format."""
    return f"Begin ModelPartData\nEnd ModelPartData\n{body}"


def block(name: str, lines: list[str]) -> str:
    """A block of lines in a file of Kratos, with its name."""
    kind = name.split(maxsplit=1)[0]
    return "\n".join([f"Begin {name}", *lines, f"End {kind}", ""])


def spheres(bodies: list[Plan]) -> str:
    """The nodes, elements and radii of the spheres, in Kratos' format."""
    numbers = [str(number) for number in range(1, len(bodies) + 1)]
    places = [
        f"{k} {' '.join(map(repr, body['position']))}"
        for k, body in zip(numbers, bodies, strict=True)
    ]
    radii = [f"{k} 0 {body['radius']!r}" for k, body in zip(numbers, bodies, strict=True)]
    members = block("SubModelPartNodes", numbers) + block("SubModelPartElements", numbers)
    return (
        block("Properties 1", [])
        + block("Nodes", places)
        + block("Elements SphericParticle3D", [f"{k} 1 {k}" for k in numbers])
        + block("NodalData RADIUS", radii)
        + block("SubModelPart Body", [members])
    )


def walls(corners: list[list[list[float]]]) -> str:
    """The rigid faces of the walls, of four corners each, in Kratos' format."""
    if not corners:
        return ""
    nodes, faces, parts = [], [], ""
    for number, four in enumerate(corners, 1):
        own = [str(FACE + 4 * number + k) for k in range(4)]
        nodes += [f"{k} {' '.join(map(repr, at))}" for k, at in zip(own, four, strict=True)]
        faces.append(f"{number} 2 {' '.join(own)}")
        data = block("SubModelPartData", ["IS_GHOST false", f"IDENTIFIER Wall{number}"])
        members = block("SubModelPartNodes", own)
        members += block("SubModelPartConditions", [str(number)])
        parts += block(f"SubModelPart {number}", [data + members])
    return (
        block("Properties 2", [])
        + block("Nodes", nodes)
        + block("Conditions RigidFace3D4N", faces)
        + parts
    )


if __name__ == "__main__":
    serve(simulate)
