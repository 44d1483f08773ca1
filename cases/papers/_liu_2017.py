"""Statements of Liu et al. (2017) on the close-packed lattice that stands for quartzite."""

from __future__ import annotations

import functools
from collections.abc import Callable
from math import exp, log, sqrt

from cases._papers import LIU_2017
from cases.bonds.parts._quartzite_lattice import (
    BLOCK,
    ELEMENT,
    FS0,
    KN,
    KS,
    MASS,
    MU_P,
    XB,
    D,
    at_faces,
    bonds_downward,
    decay_rate,
    energy_dropped,
    first_at_platens,
    first_pair,
    mean_error,
    over_printed,
    raised_strength,
    share_of_modulus,
    shear_at_break,
    softest_direction,
    strength_slid,
)
from reference_solutions.bonds import lattice_directions, tetrahedral_unit
from reference_solutions.bonds import lattice_material as theory
from reference_solutions.bonds.close_packed_lattice import SIZES, count, static
from reference_solutions.bonds.lattice_strength import first_opening
from vv.ask import Knobs
from vv.case.published import Assessment, Computed, Figure, Paper, Statement

FINEST = Knobs(2e-8)


def _number(
    place: str, what: str, printed: str, unit: str, exact: Callable[[], float], why: str = "",
    computed: tuple[Computed, ...] = (), close: float | None = None,
) -> Statement:  # fmt: skip
    """A number that is printed correctly or, with `why`, a misprint."""
    assessment = Assessment.MISPRINT if why else Assessment.REPRODUCED
    return Statement(place, what, printed, assessment, why, unit, exact, computed, close)


def _strength(variant: str, quantity: str) -> Computed:
    return Computed("tetrahedral-strength", variant, quantity, times=100.0, rung=FINEST)


def _of_path(variant: str, quantity: str) -> Computed:
    return Computed("tetrahedral-path", variant, quantity, times=100.0)


REPRODUCED, DIFFERS, MISPRINT, WRONG, OPEN = Assessment
TABLE = (
    _number("Table 1", "normal stiffness Kn (Eq. B1)", "46.794e6", "N/m", lambda: KN),
    _number("Table 1", "shear stiffness Ks (Eq. B2)", "8.068e6", "N/m", lambda: KS),
    _number("Table 1", "breaking displacement Xb (Eq. B3)", "1.704e-7", "m", lambda: XB),
    _number("Table 1", "initial shear resistance Fs0 (Eq. B4)", "18.452", "N", lambda: FS0),
    _number("Table 1", "friction coefficient mu_p (Eq. B5)", "0.3964", "", lambda: MU_P),
    _number(
        "Table 1", "coefficient of intrinsic friction that mu_p gives", "1", "",
        lambda: theory.internal_friction(MU_P),
        "B5 inverts Eq. 15, whose P is half that of the lattice, since Eq. 11a is twice the stress",
    ),
    _number("Eq. 27", "element mass", "1.874e-6", "kg",
            lambda: MASS),
    _number("Sec. 3.2", "largest Poisson's ratio, at gamma = 0", "0.2", "",
            lambda: theory.poissons_ratio(1.0, 0.0),
            computed=(Computed("tetrahedral-unit", "gamma-0", "nu"),)),
    Statement("Sec. 3.2", "Poisson's ratio at gamma = 1", "0", REPRODUCED,
              exact=lambda: theory.poissons_ratio(1.0, 1.0),
              computed=(Computed("tetrahedral-unit", "gamma-1", "nu"),)),
    *(
        Statement("Sec. 5.1", f"elements of a block of {n} a row", str(size), REPRODUCED,
                  exact=functools.partial(count, *parts))
        for size, parts in SIZES.items() for n in parts[:1]
    ),
)  # fmt: skip
EQUATIONS = (
    Statement("Eqs. 1-10, 11b, 13, 14, A1-A3, B1-B4, 27", "as printed", "", REPRODUCED,
              "derived again from the equilibrium of four elements; shown is the error of E at a "
              "strain of 1e-3, against equilibrium at finite strain",
              computed=(Computed("tetrahedral-path", "in", "E(-0.001)", Figure.ERROR),)),
    Statement("App. A", "seven equations for as many unknowns of a unit", "7", REPRODUCED,
              "their solution is Eqs. 2a to 2d", exact=lambda: 3.0 + 2.0 + 2.0),
    Statement("Sec. 3.3", "a pulled unit breaks as its inclined bonds open; their shear force then "
              "over the largest of Eq. 1", "", REPRODUCED, "the shear force is far from the limit "
              "of sliding", "",
              shear_at_break),
    Statement("Eq. 11a", "sigma_xx = sqrt6 Fx/d^2", "2.449 Fx/d^2", MISPRINT,
              "a section through the lattice, and the virial, give half as much",
              exact=lambda: sqrt(6.0) / 2.0),
    Statement("Eqs. 12 and 15", "P, what a horizontal stress adds to the axial one", "5.828",
              MISPRINT, "it is (2 + sqrt2 mu_p)/(1 - sqrt2 mu_p), half of the right value because "
              "of Eq. 11a; codes fail at a finite strain, which lowers P by 4 %",
              exact=lambda: 2.0 * theory.printed_confinement(MU_P),
              computed=(Computed("confined-strength", "two", "P"),)),
    Statement("Sec. 4.2.3", "'the maximum shear forces F_smax' of Eq. (4)'", "", MISPRINT,
              "it is of Eq. 1"),
    Statement("Eq. 23", "sliding distance: tangential displacement less 'the reduction of spring "
              "length'", "", MISPRINT, "less its increase, X_s2 - X_s1, as the equation has it"),
    Statement("Eq. 28", "(8 m Kn)^(1/2) is critical for an element fixed on a rigid boundary", "",
              WRONG, "it is critical for a spring of 2 Kn; for Kn it is (4 m Kn)^(1/2)"),
    Statement("Eq. 28", "volume V of a unit", "", OPEN, "the paper does not say which volume a "
              "single unit has: d^3/sqrt2 is its share of the lattice, d^3/(6 sqrt2) its hull"),
)  # fmt: skip
UNIT = (
    Statement("Sec. 5.2", "E of a unit at a strain of -1e-6 is quartzite's", "90", REPRODUCED,
              "codes are run to -1e-5, where E is lower by 5e-6", "GPa",
              lambda: 1e-9 * theory.youngs_modulus(KN, KS, D),
              computed=(Computed("tetrahedral-path", "in", "E(-1e-05)", times=1e-9),)),
    Statement("Sec. 5.2", "nu of a unit at a strain of -1e-6 is quartzite's", "0.16", REPRODUCED,
              "codes are run to -1e-5", "",
              exact=lambda: theory.poissons_ratio(KN, KS),
              computed=(Computed("tetrahedral-path", "in", "nu(-1e-05)"),)),
    Statement("Fig. 4a", "errors of E grow with strain; at -1e-3", "", REPRODUCED,
              unit="%", exact=lambda: 100 * (
                  tetrahedral_unit.equilibrium(-1e-3, kn=KN, ks=KS, d=D).modulus / 90e9 - 1),
              computed=(_of_path("in", "E(-0.001)-small"),)),
    Statement("Fig. 4a", "the error of E is greater beyond 1e-3, as at the strain of C_u; at -5e-3",
              "", REPRODUCED, "", "%", lambda: 100 * (
                  tetrahedral_unit.equilibrium(-5e-3, kn=KN, ks=KS, d=D).modulus / 90e9 - 1),
              (_of_path("in", "E(-0.005)-small"),)),
    Statement("Sec. 5.2", "T_u of a unit is 0.011 % lower than Eq. 7", "-0.011", DIFFERS,
              "a unit that is pulled slowly is stronger than Eq. 7 by 0.0057 %, and by 0.029 % at "
              "the paper's rate; the paper's step of 1.70e-10 m is 0.075 % of the strain at "
              "failure, more than the difference that it states",
              "%", lambda: over_printed(tetrahedral_unit.tension_failure(ELEMENT, D), 25e6),
              (_strength("pulled", "T_u over Eq. 7"),
               _strength("pulled-share", "T_u at the paper's rate"))),
    Statement("Sec. 5.2", "C_u of a unit is 1.73 % lower than Eq. 14", "-1.73", REPRODUCED,
              "pressed slowly it is 2.07 % lower; at the paper's rate with the viscosity of Eq. 28 "
              "1.81 % if V is the unit's share of the lattice, 1.59 % if it is its hull", "%",
              "-1.81 to -1.59",
              (_strength("pressed", "C_u over Eq. 14"),
               _strength("pressed-share", "C_u at the paper's rate"),
               _strength("pressed-hull", "C_u at the paper's rate"))),
    Statement("Sec. 5.2", "strain in the C_u test exceeds 4e-3", ">4e-3", REPRODUCED,
              exact=lambda: abs(tetrahedral_unit.sliding_failure(ELEMENT, D).strain)),
    Statement("Eq. 8", "C_open, of which no number is printed, of quartzite's elements", "",
              REPRODUCED, unit="MPa",
              exact=lambda: 1e-6 * theory.opening_strength(KN, KS, XB, D),
              computed=(
                  Computed("tetrahedral-strength", "pressed", "C_open", times=1e-6, rung=FINEST),)),
)  # fmt: skip
BLOCKS = (
    Statement("Sec. 5.2", "mean error of E of the blocks", "0.6", OPEN,
              "E depends on the area of the stress, which is not stated; on the hull of the "
              "centres the error is 3.64 % at 82 elements and 0.44 % at 37 681", "%",
              lambda: mean_error(0),
              tuple(Computed("close-packed-lattice", str(n), "E-excess", times=100.0)
                    for n in (82, 255, 580, 1105))),
    Statement("Sec. 5.2", "mean error of nu of the blocks", "0.6", REPRODUCED,
              "the mean of the absolute errors, with the mean of nu along x and y, which differ by "
              "up to 26 %", "%", lambda: mean_error(1, signed=False), close=0.1,
              computed=tuple(Computed("close-packed-lattice", str(n), "nu", Figure.VALUE)
                         for n in (82, 255, 580, 1105))),
    Statement("Sec. 5.2", "T_u of the blocks is lower than Eq. 7 on average", "8.89", REPRODUCED,
              "the first bond to open lies at a face: 5.8 % lower at 82 elements, 9.7 % at 37 681, "
              "8.5 % on average of the nine", "%", lambda: 8.5, close=0.5,
              computed=(
                  Computed("close-packed-strength", "pulled-82", "T_u over Eq. 7", times=-100.0),)),
    Statement("Sec. 5.2", "C_u of the blocks is lower than Eq. 14 on average", "18.51", DIFFERS,
              "between rigid smooth platens all inclined bonds slide at once, 3.4 % above Eq. 14 "
              "at 82 elements and 1.5 % below at 37 681; platens that yield give 15 to 21 % below, "
              "but the paper mentions none", "%",
              computed=(
                  Computed("close-packed-energy", "pressed-82", "C_u over Eq. 14", times=-100.0),)),
    Statement("Sec. 6", "input T_u to be raised, since blocks have 8.89 % less", "9.76",
              REPRODUCED, unit="%", exact=lambda: 100.0 * (1.0 / (1.0 - 0.0889) - 1.0)),
    Statement("Sec. 6", "blocks then have the quartzite's T_u; their T_u over it, at 82 "
              "elements", "",
              REPRODUCED, "blocks are linear until the first bond opens, so that this is right for "
              "the mean and for no single size: at 37 681 elements the ratio is "
              "0.991", "", raised_strength),
    Statement("Sec. 6", "the unit is centrosymmetric, so that along its other three axes E is the "
              "same", "1", WRONG, "hexagonal close packing is not centrosymmetric; shown is E over "
              "E_z. A box of 1687 elements is softer because of its faces, which are not "
              "layers", "",
              lambda: share_of_modulus([sqrt(8.0), 0.0, -1.0]),
              (Computed("close-packed-lattice", "vertex", "share"),)),
    Statement("Sec. 6", "E is 'a bit lower' along other directions; E over E_z in the plane of the "
              "base", "", REPRODUCED, "the smallest ratio of all directions is 0.829", "",
              lambda: share_of_modulus([1.0, 0.0, 0.0])),
    Statement("Sec. 6", "other lattices agree with finite elements (Asahina and others), so that "
              "anisotropy is not significant", "", OPEN, "this is a statement of other papers; "
              "shown is the smallest E of this lattice over E_z", "", softest_direction),
    Statement("Sec. 3.2", "Eqs. 4 and 6 also follow from the strain energy of the lattice (Wang "
              "and Mora)", "", REPRODUCED, "E of the infinite lattice along z, by strain energy, "
              "over that of Eq. 6", "", lambda: share_of_modulus([0.0, 0.0, 1.0])),
    Statement("Sec. 6", "shear forces act at the centres of elements, not at their surfaces", "",
              REPRODUCED, "the model is built like that; a unit then resists a rotation as a whole "
              "by the energy 2 Ks d^2 th^2, which no material does; shown at 1e-3 rad", "J",
              lambda: 2.0 * KS * (D * 1e-3) ** 2),
    Statement("Sec. 6", "fracturing tends to occur along the planes of the unit", "", OPEN,
              "the paper prints nothing on where the blocks break"),
    Statement("Sec. 5.1", "the models are cubic; height over width of that of 2166", "", REPRODUCED,
              "12 elements along y, 15 layers", "",
              lambda: (14.0 * sqrt(2.0 / 3.0) + 1.0) / 12.0),
    Statement("Sec. 5.1", "bonds are made 100 times as strong, so that none breaks at strains to "
              "-1e-3; the strain at which level bonds of a unit would open", "", REPRODUCED,
              "C_open over E: a unit would bear these strains with its own strength; blocks have "
              "bonds that open before",
              "", lambda: theory.opening_strength(KN, KS, XB, D)
              / theory.youngs_modulus(KN, KS, D)),
    Statement("Sec. 6", "T_u is a bit lower along other directions; over T_u of Eq. 7 along the "
              "unit's other three axes", "", REPRODUCED, "by the first bond of the infinite "
              "lattice to open; the ratio is 0.559 to 0.808 in the plane of the base and nowhere "
              "below 0.540: lower everywhere, and by more than a "
              "bit", "", lambda: lattice_directions.opening(
                  [0.0, sqrt(8.0), 1.0], kn=KN, ks=KS, xb=XB, d=D) / 25e6),
    Statement("Sec. 3.2", "nu falls as gamma grows; from gamma = 0.5 to 0", "", REPRODUCED,
              exact=lambda: theory.poissons_ratio(1.0, 0.5) - theory.poissons_ratio(1.0, 0.0)),
    Statement("Sec. 3.2", "E grows with the normal stiffness; for twice Kn over that for once", "",
              REPRODUCED, "by Eq. 6, with the Ks of quartzite", exact=lambda: (
                  theory.youngs_modulus(2.0 * KN, KS, D) / theory.youngs_modulus(KN, KS, D))),
    Statement("Figs. 4a, b", "errors of E and nu of blocks grow with the strain", "", REPRODUCED,
              "E at strains of up to 1e-3 over that at zero strain, minus 1; errors that are "
              "judged are those against equilibrium at finite strain", "%",
              computed=tuple(Computed("close-packed-path", v, "grown", times=100.0)
                         for v in ("in-82", "out-82"))),
    Statement("Figs. 4c, d", "T_u and C_u of each size", "", OPEN,
              "they are drawn and not printed; only their means are given"),
    Statement("Sec. 5.2", "bonds of a boundary element P with what lies below it", "1", REPRODUCED,
              "the fewest in the last layer of a block of 82", exact=bonds_downward),
    Statement("Sec. 5.2", "the bond of such an element breaks before all others", "", DIFFERS,
              "between smooth rigid platens a block opens first at a side; shown is how many of "
              "the two elements there touch a platen, at 82 elements", exact=first_at_platens),
    Statement("Sec. 5.1", "a step of 1e-8 s is very small; the largest stable one of the lattice",
              "", REPRODUCED, "the paper states no limit; shown is that of a block of 82 over "
              "it", "s",
              lambda: 2.0 * sqrt(MASS / (8.98102 * KN)),
              (Computed("stable-bonds", "lattice-82", "lattice"),)),
    Statement("Sec. 5.1", "after each step of the platens 100 time steps damp the waves; part of "
              "an oscillation that is left "
              "then", "", DIFFERS, "in a block of 2166, by exp(-eta t/2m) with "
              "Eq. 28 and 1e-8 s: half of the amplitude remains; a wave at sqrt(E/rho) travels 5.8 "
              "mm in that time, half the height of the "
              "block", "", lambda: exp(-decay_rate() * 1e-6 / 2.0)),
    Statement("Sec. 5.1", "kinetic energy falls quickly by Eq. 28; time in which 99 % of it goes",
              "", REPRODUCED, "in a block of 2166; it fails in 1e-4 s", "s",
              lambda: log(100.0) / decay_rate()),
    Statement("Sec. 5.1", "strain of a unit in one step of 1.70e-10 m", "", REPRODUCED,
              "five steps make the -1e-6 at which E and nu are tested", "",
              lambda: 1.70e-10 / (D * sqrt(2.0 / 3.0))),
    Statement("Sec. 5.1", "strain of a unit in one step of 1.70e-9 m, in tests of C_u", "",
              REPRODUCED, "over 1e-6 s that is 2.082 1/s, which the cases take for the paper's "
              "rate", "", lambda: 1.70e-9 / (D * sqrt(2.0 / 3.0))),
    Statement("Sec. 5.2", "strengths of blocks fall short since units at the boundary are fewer; "
              "shortfall of T_u at 37 681 elements over that at 82", "", WRONG,
              "the share of units at the boundary falls as blocks grow, but the shortfall grows: "
              "it is due to the one bond at a face that opens first. C_u of small blocks is even "
              "above Eq. 14", "",
              lambda: 9.7 / (100.0 * (1.0 - first_opening(BLOCK, static(BLOCK, KN, KS), XB) / 25e6))
              ),
    Statement("Sec. 5.2", "cracks form first around the boundaries; how many of the two elements "
              "of the first bond to open lie at a face", "", REPRODUCED, "as a block of 82 is "
              "pulled; the paper gives no number", exact=lambda: at_faces(first_pair())),
    Statement("Sec. 6", "C_u can be raised by F_s0 without changing mu_i; C_u for twice F_s0 over "
              "that for once", "", REPRODUCED, "by Eqs. 14 and 15; computed at finite "
              "displacement", "",
              lambda: strength_slid(2.0) / strength_slid(1.0)),
    Statement("Sec. 1", "heat calculated by others is up to 10 times less than by theory", "", OPEN,
              "it is of other papers, whose models are not given here"),
)  # fmt: skip
FAILURE = (
    Statement("Fig. 5", "stress grows in a line to A1, where level bonds open, and falls", "",
              REPRODUCED, "A1 over C_open of Eq. 8, minus 1, in a block of 82; the paper gives no "
              "number", "%",
              computed=(Computed("close-packed-failure", "82", "A1 over Eq. 8", times=100.0),)),
    Statement("Fig. 5", "some bonds at the boundary fail at A3, before C_open", "", REPRODUCED,
              "A3 over C_open of Eq. 8, minus 1, in a block of 82", "%",
              computed=(Computed("close-packed-failure", "82", "A3 over Eq. 8", times=100.0),)),
    Statement("Fig. 5", "stress climbs again to A2, where the block fails by sliding", "",
              REPRODUCED, "A2 over C_u of Eq. 14, minus 1, in a block of 82", "%",
              computed=(Computed("close-packed-failure", "82", "A2 over Eq. 14", times=100.0),)),
    Statement("Fig. 5", "stress falls a bit before A2 also", "", DIFFERS,
              "between rigid smooth platens it grows up to the moment at which all inclined bonds "
              "slide"),
    Statement("Sec. 5.3", "when pressed the kinetic energy is much smaller than the elastic", "",
              REPRODUCED, "largest kinetic energy over the work, in a block of 82", "%",
              computed=(
                  Computed("close-packed-energy", "pressed-82", "kinetic share", times=100.0),)),
    Statement("Sec. 5.3", "the largest kinetic share is greater when pulled than when pressed", "",
              REPRODUCED, "largest kinetic energy over the work, in a block of 82", "%",
              computed=tuple(Computed("close-packed-energy", v, "kinetic share", times=100.0)
                         for v in ("pulled-82", "pressed-82"))),
    Statement("Fig. 6c", "breaking heat of normal springs does not change as the block slides", "",
              REPRODUCED, "all level bonds have opened before, and compressed ones hold no "
              "tension; shown are the bonds that are open after three quarters of the time, over "
              "all level ones", "", "1",
              (Computed("close-packed-failure", "82-counted", "all opened"),)),
    Statement("Sec. 5.3", "the share of viscous heat is greater when pulled than when pressed", "",
              REPRODUCED, "viscous heat over all heat at the end", "%",
              computed=tuple(Computed("close-packed-energy", v, "viscous share", times=100.0)
                         for v in ("pulled-82", "pressed-82"))),
    Statement("Fig. 6c", "level bonds open before the block slides; all of them", "", REPRODUCED,
              "heat of normal springs before sliding, over that of all level bonds",
              exact="1", computed=(Computed("close-packed-failure", "82-counted", "all opened"),)),
    Statement("Fig. 6c", "frictional heat still grows after all has broken", "", REPRODUCED,
              "frictional heat at the end, in a block of 82", "J",
              computed=(Computed("close-packed-energy", "pressed-82", "Q_f", Figure.FINAL),)),
    Statement("Eqs. 16 to 22 and 24 to 26", "as printed", "", REPRODUCED,
              "the scheme computes its energies by them; shown is the remainder over the work",
              computed=(Computed("close-packed-energy", "pressed-82", "balance"),)),
    Statement("Fig. 5", "stress falls at A3 before A1", "", MISPRINT,
              "Sec. 5.3 has A3 after A2, as the end of the failure"),
    Statement("Fig. 6a", "the elastic energy drops a bit at A1; part of it, once all level bonds "
              "are open", "", REPRODUCED, "in a lattice of constant length, by Eqs. 2a and 9; the "
              "energy at A1 is a seventh of that at A2, so that the drop looks "
              "small", "%", energy_dropped),
    Statement("Sec. 5.3", "failure under pressure takes about", "1e-4", OPEN,
              "it depends on the rate of the platen, which is not given beyond 1.70e-9 m in 100 "
              "steps of 1e-8 s, and on the size; shown for 82 elements at our rate", "s", "",
              (Computed("close-packed-energy", "pressed-82", "failure time"),)),
    Statement("Sec. 5.3", "a part of the energy of the pulled block becomes breaking heat at once; "
              "that of normal and of shear springs", "", REPRODUCED, "at the end, in a block of "
              "82; it stored 1.01e-4 J", "J", "", tuple(
                  Computed("close-packed-energy", "pulled-82", q, Figure.FINAL)
                  for q in ("Q_bn", "Q_bs"))),
    Statement("Sec. 5.3", "the pulled block breaks at", "1.072e-2", OPEN,
              "1.70e-10 m in 100 steps of 1e-8 s are 1.7e-4 m/s at one end, which gives a strain "
              "of 1.59e-4 at that time, or 3.19e-4 if both ends move; failure needs 2.54e-4", "s"),
    Statement("Sec. 5.3", "largest kinetic share as the block breaks in two", "16.2", DIFFERS,
              "a block of 2166 has 13.6 %, and 82 elements have 14.7 %; the rate is not the "
              "reason", "%", "",
              (Computed("close-packed-energy", "pulled-82", "kinetic share", times=100.0),)),
    Statement("Sec. 5.3", "bonds of the block part within", "2.83e-6", DIFFERS,
              "2.4e-6 s in a block of 2166 at the paper's step, 5.3e-6 s at 4e-8 s", "s", "",
              (Computed("close-packed-energy", "pulled-82", "crack time"),)),
    Statement("Sec. 5.3", "width of the block of 2166, 12 elements", "1.2", REPRODUCED, unit="cm",
              exact=lambda: 100.0 * D * SIZES[2166][0]),
    Statement("Sec. 5.3", "speed of the crack, 1.2 cm in 2.83e-6 s", "4240", REPRODUCED,
              unit="m/s", exact=lambda: 0.012 / 2.83e-6, close=5.0),
    Statement("Fig. 6", "mechanical energy plus heat equals the external work", "", REPRODUCED,
              "remainder over the work",
              computed=(Computed("close-packed-energy", "pulled-82", "balance"),
                    Computed("close-packed-energy", "pressed-82", "balance"))),
    Statement("Sec. 5.3", "the elastic energy falls almost to zero as the pulled block breaks", "0",
              REPRODUCED, "at the end, in a block of 82; it stored 1.01e-4 J", "J", "",
              (Computed("close-packed-energy", "pulled-82", "E_e", Figure.FINAL),)),
    Statement("Fig. 6a", "the elastic energy falls almost to zero as the pressed block fails", "0",
              REPRODUCED, "at the end, in a block of 82; it stored 2.17e-2 J", "J", "",
              (Computed("close-packed-energy", "pressed-82", "E_e", Figure.FINAL),)),
    Statement("Sec. 5.3", "kinetic energy becomes viscous heat in the end", "0", REPRODUCED,
              "the kinetic energy that is left, in a block of 82; it was 1.47e-5 J", "J", "",
              (Computed("close-packed-energy", "pulled-82", "E_k", Figure.FINAL),)),
    Statement("Fig. 6d", "viscous heat still grows after the block has broken", "", REPRODUCED,
              "18 % of it appears after 99 % of the breaking heat, in a block of 82; shown is all "
              "of it", "J",
              "", (Computed("close-packed-energy", "pulled-82", "Q_v", Figure.FINAL),)),
    Statement("Fig. 6c", "breaking heat remains constant once all has failed", "", REPRODUCED,
              "there is no breaking heat after the last bond breaks; shown is that of shear "
              "springs at the end, in a block of 82", "J", "",
              (Computed("close-packed-energy", "pressed-82", "Q_bs", Figure.FINAL),)),
    Statement("Sec. 5.3", "no frictional heat as the block is pulled in two", "0", REPRODUCED,
              unit="J", exact=lambda: 0.0,
              computed=(Computed("close-packed-energy", "pulled-82", "Q_f", Figure.FINAL),)),
)  # fmt: skip
PAPER = Paper("Liu et al. (2017)", *LIU_2017, TABLE + EQUATIONS + UNIT + BLOCKS + FAILURE)
