"""Draws error against cost: a curve for each scheme, with its name at the end."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from vv.insight.effort import Effort

COLOURS = ("#0b6e4f", "#c1121f", "#1d4ed8", "#9a5b00", "#6d28d9", "#374151")
MARKERS = "osD^vP"


def picture(every: Sequence[Effort], title: str, file: Path) -> None:
    """Draw the smallest error reached over the CPU time of the stepping loop, on logarithmic axes.

    The file name decides the format, svg or png. The same results give the same bytes.
    """
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context({"svg.hashsalt": "vv", "font.size": 12, "svg.fonttype": "path"}):
        figure = Figure(figsize=(8.4, 4.6), layout="constrained")
        axes = figure.add_subplot()
        for number, one in enumerate(every):
            points = [(p.cpu, p.error) for p in one.points if p.cpu and p.error]
            if not points:
                continue
            cpu, error = zip(*sorted(points), strict=True)
            colour = COLOURS[number % len(COLOURS)]
            marker = MARKERS[number % len(MARKERS)]
            axes.loglog(cpu, error, marker=marker, color=colour, lw=2, ms=7)
            axes.annotate(
                _name(one), (cpu[-1], error[-1]), (9, 4), textcoords="offset points",
                color=colour, va="top", fontweight="bold", fontsize=11,
            )  # fmt: skip
        axes.set(xlabel="CPU time of the stepping loop [s]", ylabel="largest relative error")
        axes.set_title(title, loc="left")
        axes.grid(True, which="major", color="#ddd")
        axes.margins(x=0.05)
        low, high = axes.get_xlim()
        axes.set_xlim(low, high * 6)  # room for the names
        axes.set_ylim(axes.get_ylim()[0] / 8)
        axes.spines[["top", "right"]].set_visible(False)
        figure.savefig(file, metadata={"Date": None} if file.suffix == ".svg" else None, dpi=110)


def _name(one: Effort) -> str:
    """The scheme below its code, and the observed order in dt."""
    code, _, scheme = one.label.partition("/")
    order = next((row.order for row in one.rows if row.order), None)
    return f"{code}\n{scheme}" + (f"\norder {order.order:.1f}" if order else "")
