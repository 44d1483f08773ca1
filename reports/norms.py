"""The short names of norms."""

from vv.case import Norm

NORM_NAMES = {
    Norm.MAX: "max",
    Norm.FINAL: "final",
    Norm.POINTWISE: "pointwise",
    Norm.L2: "L2",
}
