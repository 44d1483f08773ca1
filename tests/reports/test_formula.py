"""Claims about typeset formulas: nothing is lost, words stay words, and all text is escaped."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.formula import GREEK, MINUS, PRIME, SIGNS, typeset


def read(formula: str) -> ElementTree.Element:
    """The root element of a typeset formula."""
    return ElementTree.fromstring(f"<p>{typeset(formula)}</p>")


def said(formula: str) -> str:
    """The text of a typeset formula as it was typed, without blanks and signs of position."""
    text = "".join(read(formula).itertext())
    for word, sign in {**GREEK, **SIGNS}.items():
        text = text.replace(sign, word)
    return text


def bare(text: str) -> str:
    return re.sub(r"[\s_^(){}\[\]]|sqrt", "", text)


@pytest.mark.parametrize(
    ("formula", "inner"),
    [
        ("w^2", "<msup><mi>w</mi><mn>2</mn></msup>"),
        ("u_i''", "<msubsup><mi>u</mi><mi>i</mi><mo>″</mo></msubsup>"),
        ("q'^2", f"<msup><msup><mi>q</mi><mo>{PRIME}</mo></msup><mn>2</mn></msup>"),
        ("sqrt(k/m)", "<msqrt><mi>k</mi><mo>/</mo><mi>m</mi></msqrt>"),
        ("U^(3/2)", "<msup><mi>U</mi><mrow><mn>3</mn><mo>/</mo><mn>2</mn></mrow></msup>"),
        ("theta0 <= -1", f"<msub><mi>θ</mi><mn>0</mn></msub><mo>≤</mo><mo>{MINUS}</mo><mn>1</mn>"),
        ("sin wt", '<mo lspace="0" rspace=".16em">sin</mo><mspace width=".2em"/><mi>wt</mi>'),
    ],
)
def test_what_is_typed_is_typeset(formula: str, inner: str) -> None:
    assert str(typeset(formula)) == f"<math>{inner}</math>"


def test_words_stay_words_between_formulas() -> None:
    formula = "U'' = g while it slides; the springs' own w at rest: k = 2"
    whole = read(formula)
    prose = " ".join([whole.text or "", *(one.tail or "" for one in whole)])
    assert re.findall(r"[a-z]+", prose) == [
        *["while", "it", "slides", "the", "springs", "own", "at", "rest"]
    ]
    assert len(whole) == 3


SIGNS_TYPED = """ab2 _^()'<>=-+/|;:,.{}[]sqrtinx&\\"""


@given(st.text(SIGNS_TYPED, max_size=25))
def test_nothing_is_lost_and_all_is_escaped(formula: str) -> None:
    assert sorted(bare(said(formula))) == sorted(bare(formula))  # below is before above
