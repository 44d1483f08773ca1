"""No text of unknown origin steers a terminal, forges a line or breaks an XML file."""

import xml.etree.ElementTree as ET
from xml.sax.saxutils import escape

import pytest

from vv.base.printable import one_line, printable


@pytest.mark.parametrize("code", range(32))
def test_no_control_character_is_left(code: int) -> None:
    text = f"a{chr(code)}b"
    assert one_line(text).isprintable()
    assert printable(text).replace("\t", "").replace("\n", "").isprintable()
    assert ET.fromstring(f"<a>{escape(printable(text))}</a>").text == printable(text)


@pytest.mark.parametrize(
    "hostile", ["\x7f", "\x9b", "\u202e", "\u2066", "\ud800", "\ufeff", "\ufffe"]
)
def test_what_reorders_or_cannot_be_written_is_shown(hostile: str) -> None:
    assert printable(hostile).isascii()
    assert printable(hostile).startswith("\\")


def test_a_text_in_several_lines_becomes_one() -> None:
    assert one_line("failed:\r\n  at x\n\n\ngate: green") == "failed: at x gate: green"
    assert one_line("Größe  10 µm") == "Größe  10 µm"
