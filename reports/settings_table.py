"""Writes the rows of the table of all settings, quickly, since a report has tens of thousands.

Rows have no end tags, which HTML does not require.
"""

from __future__ import annotations

from markupsafe import Markup, escape

from reports import text
from reports.variant.settings import Group, Setting
from vv.records.job_record import Record


def setting_rows(group: Group, stiffness: bool, valued: bool, columns: int) -> Markup:
    """The rows of a group of settings; stiffness, valued: whether there are columns of it.

    The cost of a setting is shown with the first quantity of a scheme; in the groups of other
    quantities, steps with equal results share a row.
    """
    rows = [(text.brief(row.record.rung.dt), _came(row, stiffness, valued)) for row in group.rows]
    if group.first:
        costs = [_cost(row.record) for row in group.rows]
        made = [f"<tr><td>{dt}{came}{cost}" for (dt, came), cost in zip(rows, costs, strict=True)]
    else:
        steps: dict[str, list[str]] = {}
        for dt, came in rows:
            steps.setdefault(came, []).append(dt)
        made = [f"<tr><td>{', '.join(own)}{came}" for came, own in steps.items()]
    return Markup("\n".join([*([_heading(group, columns)] if group.titled else []), *made]))


def _heading(group: Group, columns: int) -> str:
    """The heading of a group of settings."""
    unit = f" [{group.unit}]" if group.unit else ""
    found = group.order
    order = (
        f" · order {found.order:.2f} ± {found.spread:.2f} over {found.points} steps"
        if found
        else ""
    )
    title = escape(f"{group.mark.label} · {group.quantity}{unit}{order}")
    notes = "".join(f"<small>{escape(note)}</small>" for note in group.notes)
    return f"<tbody><tr><th scope=rowgroup colspan={columns}>{title}{notes}"


def _came(row: Setting, stiffness: bool, valued: bool) -> str:
    """The cells of the results: numbers, order, verdict."""
    one = row.quantity
    numbers = [text.brief(row.record.rung.kn)] if stiffness else []
    numbers += [text.brief(one.value), text.brief(one.reference)] if valued else []
    numbers += [text.sci(one.error), text.sci(one.tolerance, 1)]
    numbers += [text.NONE if row.local is None else f"{row.local:z.2f}"]
    cells = "".join(f"<td>{number}" for number in numbers)  # numbers, which need no escaping
    note = f" <small>{escape(row.note)}</small>" if row.note else ""
    look = "" if row.outcome.look == "good" else f' class="{row.outcome.look}"'
    return f"{cells}<td{look}>{row.outcome.symbol} {row.outcome.word}{note}"


def _cost(record: Record) -> str:
    """The cells of the cost of a setting."""
    marks = ("" if record.cost.timed else " ○") + (" ◻" if record.cost.whole else "")
    return f"<td>{text.seconds(record.cost.solve_cpu or None)}{marks}<td>{record.steps}"
