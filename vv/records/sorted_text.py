"""Writes baselines and recorded results sorted, one result a line, so that diffs are readable."""

from __future__ import annotations

from vv.records import codec


def render(kept: object) -> str:
    """The JSON text of a file of results."""
    data = codec.to_data(kept)
    parts = []
    for name in sorted(data):
        value = data[name]
        if isinstance(value, dict) and value:
            lines = (f"  {codec.render(k)}: {_line(value[k])}" for k in sorted(value))
            parts.append(f" {codec.render(name)}: {{\n" + ",\n".join(lines) + "\n }")
        else:
            parts.append(f" {codec.render(name)}: {_line(value)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _line(value: object) -> str:
    return codec.render(value, sort_keys=True)
