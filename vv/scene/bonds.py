"""Bonds between spheres: frozen data, checked when it is created."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from vv.scene.arrays import Mask, Vector, freeze

Pairs = npt.NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Bonds:
    """b pairs of spheres, each held together by a normal and a shear spring until it breaks.

    pairs: (b, 2) body numbers; length: (b,) [m] of the unstretched bond; kn, ks: (b,) [N/m];
    tension: (b,) [N], the normal force that opens a bond; shear: (b,) [N], the shear force that
    breaks it at zero normal force. A scalar applies to all bonds; an infinite strength means that
    a bond never breaks.

    Fn = kn (L - length), tension positive. The shear force ks S starts at zero, grows with the
    motion of the two surfaces across the bond, and turns with the bond (Cundall and Strack 1979);
    where a sphere cannot spin that is the motion of its centre. A bond breaks for good when
    Fn > tension or |Fs| > shear - mu Fn, with the mu of the scene's contact (Liu et al. 2017,
    Eq. 1). Only after that may its two spheres be in contact as any others.
    Raises ValueError naming the first pair or value that is wrong.
    """

    pairs: Pairs
    length: Vector
    kn: Vector
    ks: Vector
    tension: Vector = np.inf  # type: ignore[assignment]  # becomes an array (b,)
    shear: Vector = np.inf  # type: ignore[assignment]  # becomes an array (b,)

    def __post_init__(self) -> None:
        given = np.asarray(self.pairs)
        if given.ndim != 2 or given.shape[1] != 2 or given.dtype.kind not in "iu":
            what = f"shape {given.shape} and type {given.dtype}"
            raise ValueError(f"Bonds.pairs has {what}; it must be (b, 2) whole body numbers")
        if not len(given):
            raise ValueError("Bonds.pairs is empty; a scene without bonds has Scene.bonds None")
        freeze(self, "pairs", given.shape, "", np.int64)
        _check_pairs(self.pairs)
        for name, unit in (("length", "m"), ("kn", "N/m"), ("ks", "N/m")):
            object.__setattr__(self, name, np.broadcast_to(getattr(self, name), len(self)))
            freeze(self, name, (len(self),), unit)
        for name in ("tension", "shear"):
            _freeze_strength(self, name)
        for name, unit in (("length", "m"), ("kn", "N/m"), ("tension", "N"), ("shear", "N")):
            _require(self, name, getattr(self, name) > 0, unit, "positive")
        _require(self, "ks", self.ks >= 0, "N/m", "zero or more")

    def __len__(self) -> int:
        return len(self.pairs)

    @property
    def breakable(self) -> Mask:
        """A mask (b,) of the bonds with a finite strength."""
        return np.isfinite(self.tension) | np.isfinite(self.shear)


def _check_pairs(pairs: Pairs) -> None:
    for k in np.flatnonzero((pairs < 0).any(axis=1))[:1]:
        raise ValueError(f"Bonds.pairs[{k}] = {pairs[k].tolist()}; body numbers start at 0")
    for k in np.flatnonzero(pairs[:, 0] == pairs[:, 1])[:1]:
        raise ValueError(f"Bonds.pairs[{k}] = {pairs[k].tolist()}; a bond joins two bodies")
    _, first, times = np.unique(np.sort(pairs), axis=0, return_index=True, return_counts=True)
    for k in first[times > 1][:1]:
        raise ValueError(
            f"Bonds.pairs[{k}] = {pairs[k].tolist()} is listed twice; a pair has one bond"
        )


def _freeze_strength(bonds: Bonds, name: str) -> None:
    """Like `freeze`, but infinite values are allowed: the bond never breaks."""
    array = np.array(np.broadcast_to(getattr(bonds, name), len(bonds)), dtype=float)
    array.flags.writeable = False
    object.__setattr__(bonds, name, array)


def _require(bonds: Bonds, name: str, good: Mask, unit: str, rule: str) -> None:
    for k in np.flatnonzero(~good)[:1]:
        value = float(getattr(bonds, name)[k])
        raise ValueError(f"Bonds.{name}[{k}] = {value!r} {unit}; it must be {rule}")
