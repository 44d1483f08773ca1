"""Claims about the driver of Kratos, without it: files, settings, starts and readings, by hand."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.support.adapters.fake_modules import driver_with
from vv.codes.driver_protocol import Stopwatch

DT = 0.1
ROOT = "KratosMultiphysics"


class Node:
    """Notes what it is given; it flies on with its velocity."""

    def __init__(self, place: list[float]) -> None:
        self.X, self.Y, self.Z = place
        self.given: dict[str, Any] = {}
        self.fixed: list[str] = []

    def SetSolutionStepValue(self, name: str, value: Any) -> None:  # noqa: N802
        self.given[name] = value

    def GetSolutionStepValue(self, name: str) -> Any:  # noqa: N802
        return self.given[name]

    def Fix(self, name: str) -> None:  # noqa: N802
        self.fixed.append(name)


class Stage:
    """An analysis whose nodes lie where the file of spheres says."""

    made: Stage

    def __init__(self, model: Any, parameters: str) -> None:
        Stage.made, self.settings = self, json.loads(parameters)
        self.times: list[float] = []
        self.called: list[str] = []

    def Initialize(self) -> None:  # noqa: N802
        text = Path("spheresDEM.mdpa").read_text().partition("Begin Nodes\n")[2]
        rows = [row.split() for row in text.partition("End")[0].splitlines()]
        nodes = {int(row[0]): Node([*map(float, row[1:])]) for row in rows}
        self.spheres_model_part = SimpleNamespace(Nodes=nodes)

    def _GetSolver(self) -> Stage:  # noqa: N802
        return self

    def AdvanceInTime(self, now: float) -> float:  # noqa: N802
        self.times.append(now)
        for node in self.spheres_model_part.Nodes.values():
            v = node.given["VELOCITY"]
            node.X, node.Y, node.Z = node.X + DT * v[0], node.Y + DT * v[1], node.Z + DT * v[2]
        return now + DT

    def __getattr__(self, name: str) -> Any:
        return lambda: self.called.append(name)


@pytest.fixture
def driver(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    monkeypatch.chdir(tmp_path)
    silent = SimpleNamespace(SetSeverity=lambda severity: None)
    logger = SimpleNamespace(GetDefaultOutput=lambda: silent, Severity=SimpleNamespace(WARNING=1))
    moves = ("VELOCITY", "ANGULAR_VELOCITY")
    names = [*moves, "NODAL_MASS", "EXTERNAL_APPLIED_FORCE", "TOTAL_FORCES"]
    names += [f"{name}_{axis}" for name in moves for axis in "XYZ"]
    kratos = {name: name for name in names} | {
        "Logger": logger, "Model": lambda: None, "Parameters": lambda text: text, "Node": Node,
        "Array3": list,
    }  # fmt: skip
    dem = {"PARTICLE_MOMENT_OF_INERTIA": "INERTIA"}
    yield from driver_with("adapters.kratos.driver", {
        ROOT: kratos | {"DEMApplication": SimpleNamespace(**dem)},
        f"{ROOT}.DEMApplication": dem,
        f"{ROOT}.DEMApplication.DEM_analysis_stage": {"DEMAnalysisStage": Stage},
    })  # fmt: skip


def sphere(**changes: Any) -> dict[str, Any]:
    whole = {
        "position": [1.0, 2.0, 3.0], "velocity": [0.5, 0.0, -0.25], "spin": [0.0, 3.0, 0.0],
        "radius": 0.5, "mass": 2.0, "inertia": 0.2, "force": [1.0, 0.0, 2.0],
        "start": [4.0, 0.0, 5.0], "free": [True, False, True], "free_spin": [False, True, False],
    }  # fmt: skip
    return {**whole, **changes}


def asked(**changes: Any) -> dict[str, Any]:
    still = sphere(position=[9.0, 8.0, 7.0], radius=0.25, velocity=[0.0, 1.0, 0.0], mass=3.0,
                   free_spin=[False] * 3)  # fmt: skip
    whole = {
        "dt": DT, "steps": 4, "stride": 2, "law": {"kn": 5e6, "ks": 4e6}, "mu": 0.3,
        "spheres": [sphere(), still], "walls": [], "observe": [["displacement", 0], ["velocity", 1],
                                                               ["displacement", 1]],
    }  # fmt: skip
    return {**whole, **changes}


def test_displacements_are_from_the_start_and_velocities_as_they_are(driver: Any) -> None:
    values, facts = driver.simulate(asked(), True, Stopwatch())
    assert (values.shape, facts) == ((3, 3, 3), {})
    for row, t in enumerate((0.0, 0.2, 0.4)):
        assert values[0, row] == pytest.approx([0.5 * t, 0.0, -0.25 * t])
        assert values[1, row].tolist() == [0.0, 1.0, 0.0]
        assert values[2, row] == pytest.approx([0.0, t, 0.0])
    assert Stage.made.times == pytest.approx([0.0, 0.1, 0.2, 0.3])
    assert Stage.made.called.count("SolveSolutionStep") == 4
    unwatched, _ = driver.simulate(asked(), False, Stopwatch())
    assert not unwatched[:, 1:].any()


def test_a_sphere_is_given_its_own_mass_inertia_motion_and_locks(driver: Any) -> None:
    node = Node([0.0] * 3)
    driver.start(node, sphere(), True)
    assert node.given == {
        "NODAL_MASS": 2.0, "INERTIA": 0.2, "VELOCITY": [0.5, 0.0, -0.25],
        "ANGULAR_VELOCITY": [0.0, 3.0, 0.0], "EXTERNAL_APPLIED_FORCE": [1.0, 0.0, 2.0],
        "TOTAL_FORCES": [4.0, 0.0, 5.0],
    }  # fmt: skip
    assert node.fixed == ["VELOCITY_Y", "ANGULAR_VELOCITY_X", "ANGULAR_VELOCITY_Z"]
    straight = Node([0.0] * 3)
    driver.start(straight, sphere(), False)
    assert straight.fixed == ["VELOCITY_Y"]
    assert "INERTIA" not in straight.given


def test_rotation_is_on_where_any_sphere_may_turn(driver: Any) -> None:
    assert driver.settings(asked())["RotationOption"] is True
    none = asked(spheres=[sphere(free_spin=[False] * 3)])
    assert driver.settings(none)["RotationOption"] is False


def test_settings_are_undamped_and_last_a_step_longer(driver: Any) -> None:
    found = driver.settings(asked())
    assert found["MaxTimeStep"] == 0.1
    assert found["FinalTime"] == pytest.approx(0.5)
    assert found["SearchTolerance"] == found["search_tolerance_against_walls"] == 0.1 * 0.25
    assert (found["VirtualMassCoefficient"], found["GlobalDamping"]) == (1.0, 0.0)
    assert [found[f"Gravity{axis}"] for axis in "XYZ"] == [0.0] * 3
    never = (found[n] for n in ("GraphExportFreq", "VelTrapGraphExportFreq", "OutputTimeStep"))
    assert [*never] == [1e9] * 3


def test_springs_are_properties_of_spheres_and_of_their_contacts(driver: Any) -> None:
    found = driver.materials(asked())
    ball, wall = (one["Variables"] for one in found["materials"])
    springs = {"K_NORMAL": 5e6, "K_TANGENTIAL": 4e6}
    elastic = {"PARTICLE_DENSITY": 1000.0, "YOUNG_MODULUS": 1e9, "POISSON_RATIO": 0.2}
    assert ball == elastic | springs
    assert wall == {"YOUNG_MODULUS": 1e20, "POISSON_RATIO": 0.2, "COMPUTE_WEAR": False}
    for one in found["material_relations"]:
        law = one["Variables"]
        assert law | springs == law
        assert law["DEM_DISCONTINUUM_CONSTITUTIVE_LAW_NAME"] == "DEM_D_Linear_Custom_Constants"
        assert law["STATIC_FRICTION"] == law["DYNAMIC_FRICTION"] == 0.3
        assert (law["COEFFICIENT_OF_RESTITUTION"], law["DAMPING_GAMMA"]) == (1.0, 0.0)
        assert (law["FRICTION_DECAY"], law["BRINELL_HARDNESS"]) == (500.0, 1.0)
    ids = [one["material_ids_list"] for one in found["material_relations"]]
    assert ids == [[1, 1], [1, 2]]


def test_elastic_spheres_and_walls_are_of_one_material(driver: Any) -> None:
    found = driver.materials(asked(law={"young": 7e9, "poisson": 0.25}))
    for one in found["materials"]:
        assert one["Variables"]["YOUNG_MODULUS"] == 7e9
        assert one["Variables"]["POISSON_RATIO"] == 0.25
        assert "K_NORMAL" not in one["Variables"]
    (law, _) = (one["Variables"] for one in found["material_relations"])
    assert law["DEM_DISCONTINUUM_CONSTITUTIVE_LAW_NAME"] == "DEM_D_Hertz_viscous_Coulomb"


def blocks(text: str) -> dict[str, list[str]]:
    """Name of each innermost block of a file -> its lines; of blocks of one name the last."""
    found: dict[str, list[str]] = {}
    name = ""
    for line in text.splitlines():
        if line.startswith("Begin "):
            name = line.removeprefix("Begin ")
            found[name] = []
        elif line.startswith("End "):
            name = ""
        elif name and line:
            found[name].append(line)
    return found


def test_files_of_spheres_and_walls_number_from_one_and_from_a_million(
    driver: Any, tmp_path: Path
) -> None:
    walls = [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 0.0]],
             [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [1.0, 2.0, 5.0], [0.0, 2.0, 5.0]]]  # fmt: skip
    driver.write_input(asked(walls=walls))
    balls = blocks((tmp_path / "spheresDEM.mdpa").read_text())
    assert list(balls)[:3] == ["ModelPartData", "Properties 1", "Nodes"]
    assert balls["Nodes"] == ["1 1.0 2.0 3.0", "2 9.0 8.0 7.0"]
    assert balls["Elements SphericParticle3D"] == ["1 1 1", "2 1 2"]
    assert balls["NodalData RADIUS"] == ["1 0 0.5", "2 0 0.25"]
    assert balls["SubModelPartNodes"] == balls["SubModelPartElements"] == ["1", "2"]
    faces = blocks((tmp_path / "spheresDEM_FEM_boundary.mdpa").read_text())
    first, second = (list(range(1_000_000 + 4 * n, 1_000_004 + 4 * n)) for n in (1, 2))
    corners = [corner for wall in walls for corner in wall]
    assert faces["Nodes"] == [
        f"{k} {' '.join(map(repr, corner))}"
        for k, corner in zip([*first, *second], corners, strict=True)
    ]
    assert faces["Conditions RigidFace3D4N"] == [
        f"{n} 2 {' '.join(map(str, own))}" for n, own in ((1, first), (2, second))
    ]
    assert list(faces)[:2] == ["ModelPartData", "Properties 2"]
    assert faces["SubModelPartNodes"] == [str(k) for k in second]
    assert faces["SubModelPartData"] == ["IS_GHOST false", "IDENTIFIER Wall2"]
    assert faces["SubModelPartConditions"] == ["2"]
    assert json.loads((tmp_path / "spheres.json").read_text()) == driver.materials(asked())
    assert driver.walls([]) == ""
