"""Translates bonds for YADE into permanent contacts, and says which bonds are not possible."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from adapters.yade.given import Given
from adapters.yade.setup import Setup
from vv.scene import Mask, Scene

STRONG = 1e300  # N


def bonds(given: Given, setup: Setup) -> Given:
    """Bonds as contacts that carry tension; no other contacts are created at the start."""
    note = "bonds are contacts of CohFrictMat, made before the first step, brittle where they break"
    contacts = given.numbers["contacts"] + len(setup.scene.bonded_pairs)
    return given.with_more(note, bonds=_rows(setup.scene), contacts=contacts)


def sheared_bonds(given: Given, setup: Setup) -> Given:
    """Shear springs of bonds; as for contacts, the velocity in the first step must be zero."""
    likewise = "spheres on a bond that resists shear also get their velocity by an impulse"
    notes = [likewise] if setup.scene.spheres.velocity.any() else []
    return replace(given.with_more(*notes), pushed=given.pushed | sheared(setup.scene))


def _rows(scene: Scene) -> list[dict[str, Any]]:
    """The bonds of a scene as input of the driver.

    Where the length of a bond differs from the sum of the radii, its force is zero at that overlap.
    An infinite strength becomes one that no force reaches.
    """
    if scene.bonds is None:
        return []
    reach = scene.spheres.radius[scene.bonded_pairs].sum(axis=1)
    columns = {
        "pair": scene.bonds.pairs,
        "kn": scene.bonds.kn,
        "ks": scene.bonds.ks,
        "overlap": reach - scene.bonds.length,
        "tension": np.minimum(scene.bonds.tension, STRONG),
        "shear": np.minimum(scene.bonds.shear, STRONG),
    }
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    return [dict(zip(columns, row, strict=True)) for row in rows]


def sheared(scene: Scene) -> Mask:
    """Which spheres, (n,), are on a bond that resists shear."""
    on = np.zeros(len(scene.spheres), bool)
    if scene.bonds is not None:
        on[scene.bonded_pairs[scene.bonds.ks > 0]] = True
    return on


def why_no_bonds(scene: Scene) -> str | None:
    """Why YADE cannot represent the bonds of a scene; None if it can, or there are none."""
    if scene.bonds is not None and scene.walls:
        return "the scene has walls beside bonds; YADE's law of bonds acts between spheres only"
    return None
