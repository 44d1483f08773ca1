"""What a program or a store says is shown, and neither obeyed nor believed to be markup."""

import dataclasses
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from tests.support.fabricated import changed, manifest_of_all
from vv.gate.judgement import judgement
from vv.output import progress, result_lines
from vv.output.junit import write_junit
from vv.output.markdown import summary, workflow_commands
from vv.records.manifest import Manifest
from vv.store.store import Store

EVERY_CONTROL = "".join(map(chr, range(32)))
HOSTILE = f"<script>a{EVERY_CONTROL}b\n::error::forged\n## x ![p](http://bad.example/x)\x9b\u202e"


@pytest.fixture
def manifest(tmp_path: Path) -> Manifest:
    made = manifest_of_all(Store(tmp_path))
    records = tuple(changed(r, reason=HOSTILE, code_version=HOSTILE) for r in made.records)
    findings = tuple(dataclasses.replace(f, text=HOSTILE) for f in made.findings)
    where = dataclasses.replace(made.provenance, utc=HOSTILE, commit=HOSTILE)
    return dataclasses.replace(made, records=records, findings=findings, provenance=where)


def test_the_junit_file_is_well_formed_whatever_was_said(
    manifest: Manifest, tmp_path: Path
) -> None:
    write_junit(tmp_path / "out.xml", manifest, judgement(manifest, ("nobody",)))
    text = (tmp_path / "out.xml").read_text()
    messages = [one.get("message", "") for one in ET.fromstring(text).iter("error")]
    assert any("\\x1b" in message for message in messages)
    assert "\x1b" not in text


def test_the_summary_holds_no_control_no_markup_and_no_forged_line(manifest: Manifest) -> None:
    text = summary(manifest, judgement(manifest))
    assert text.replace("\n", "").isprintable()
    assert "<script" not in text
    assert "![p](" not in text
    assert not any(line.startswith(("::", "## ")) for line in text.splitlines())


def test_annotations_are_one_line_each_without_controls(manifest: Manifest) -> None:
    lines = workflow_commands(judgement(manifest), {})
    assert lines
    assert all(line.replace("\t", "").isprintable() for line in lines)


def test_the_terminal_gets_lines_that_steer_nothing(
    manifest: Manifest, capsys: pytest.CaptureFixture[str]
) -> None:
    result_lines.print_refusals(manifest.records)
    result_lines.print_table(manifest.records, judgement(manifest))
    result_lines.print_findings(judgement(manifest), manifest.records)
    result_lines.print_changes([], manifest, manifest, 5)
    with progress.progress() as shown:
        shown.begin(len(manifest.records))
        for record in manifest.records:
            shown.done(record)
    out, err = capsys.readouterr()
    assert (out + err).replace("\n", "").isprintable()
    assert not any(line.startswith("::") for line in (out + err).splitlines())
