"""Times YADE's bonded model on a lattice: python3 yade_lattice.py CENTRES.npy STEPS OUT.json.

It runs in the system's python3, for which YADE is built. Bonds do not break, and spheres do not
rotate. The output holds the number of bonds and the least CPU seconds of two runs.
"""

import glob
import json
import os
import sys
import time

import numpy as np

os.environ["OMP_NUM_THREADS"] = "1"  # read when YADE is imported
sys.path.insert(0, os.environ.get("VV_YADE") or next(iter(glob.glob("/usr/lib/*/yade-double/py"))))

import yade
from yade import utils
from yade import wrapper as yd

KN, KS, M, D, SPEED, DT = 46793831.1079, 8067901.91516, 1.87383297e-6, 1e-3, 1e-2, 1e-8


def build(centres: np.ndarray) -> None:
    """Create touching spheres, and engines that bond them in the first step."""
    material = yd.CohFrictMat(
        young=KN / (D / 2), poisson=KS / KN, isCohesive=True, normalCohesion=1e12,
        shearCohesion=1e12, momentRotationLaw=False,
    )  # fmt: skip
    yade.O.materials.append(material)
    velocities = np.random.default_rng(1).normal(size=centres.shape) * SPEED
    for centre, velocity in zip(centres.tolist(), velocities.tolist(), strict=True):
        state = yade.O.bodies[yade.O.bodies.append(utils.sphere(centre, D / 2))].state
        state.mass, state.vel, state.blockedDOFs = M, velocity, "XYZ"
    boxes = yd.Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05)
    touch = yd.Ig2_Sphere_Sphere_ScGeom6D(
        interactionDetectionFactor=1.05, avoidGranularRatcheting=False
    )
    spring = yd.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)
    law = yd.Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=True)
    yade.O.engines = [
        yd.ForceResetter(),
        yd.InsertionSortCollider([boxes], verletDist=0.025 * D),
        yd.InteractionLoop([touch], [spring], [law]),
        yd.NewtonIntegrator(damping=0),
    ]
    yade.O.dt = DT
    yade.O.step()
    boxes.aabbEnlargeFactor = touch.interactionDetectionFactor = 1


def main(centres: str, steps: str, out: str) -> None:
    """Build the lattice, time it, and write the output."""
    build(np.load(centres))
    seconds = []
    for _ in range(2):
        begun = time.process_time()
        yade.O.run(int(steps), True)
        seconds.append(time.process_time() - begun)
    answer = {"bonds": yade.O.interactions.countReal(), "seconds": min(seconds)}
    with open(out, "w") as file:
        json.dump(answer, file)


if __name__ == "__main__":
    main(*sys.argv[1:])
    os._exit(0)  # YADE's own shutdown needs a display
