"""What is damaged in a store is reported, ignored, and made again."""

import copy
import dataclasses
import functools
import io
import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.conftest import Tiny
from tests.support.fabricated import changed, manifest, record
from vv.insight.history import history
from vv.records import codec
from vv.records.job_record import Record
from vv.store import manifest_text
from vv.store.array_files import arrays_in
from vv.store.seal import opened_bytes, sealed_bytes
from vv.store.store import Store

SELECTION = ("run", "fall:up", "--codes", "fake/good")


def jobs(*cases: str) -> list[Record]:
    """A record of each of these cases, which number tells apart."""
    return [record("dem/default", "T1", 1e-3, case=case, steps=n) for n, case in enumerate(cases)]


def test_a_past_run_can_be_read_in_part(tmp_path: Path) -> None:
    store, records = Store(tmp_path), jobs("b", "b", "a")
    kept = manifest(*records, name="01")
    store.manifests.keep(kept)
    assert store.manifests.read("01") == kept
    assert store.manifests.head("01") == (("b", "a"), kept.provenance)
    assert store.manifests.records_of("01", "b") == tuple(records[:2])
    assert store.manifests.records_of("01", "c") == ()


def test_a_damaged_manifest_fails_where_it_is_damaged_only(tmp_path: Path) -> None:
    store, path = Store(tmp_path), tmp_path / "manifests" / "01.json"
    records = jobs("b", "a")
    store.manifests.keep(manifest(*records, name="01"))
    path.write_text(path.read_text().replace('"steps": 1', '"steps": 7'))
    assert store.manifests.records_of("01", "b") == (records[0],)
    with pytest.raises(OSError, match="its content is not what was stored: the digest differs"):
        store.manifests.read("01")
    with pytest.raises(OSError, match="the list of records of a is not what was stored"):
        store.manifests.records_of("01", "a")
    path.write_text('{"provenance": {}, "records": []}')
    for read in (store.manifests.read, store.manifests.head):
        with pytest.raises(OSError, match="its first line has no seal: it is of an older form"):
            read("01")


@pytest.mark.parametrize("body", ['"records": []}\n', '"cases": {}}\n'])
def test_a_manifest_whose_records_are_not_grouped_by_case_is_none(body: str) -> None:
    """Sealed as it is."""
    text = manifest_text._sealed("01", manifest(name="01").provenance, {}, body)
    with pytest.raises(ValueError, match="its records are not grouped by case"):
        manifest_text.whole(text, "01")


def test_a_case_whose_records_are_lost_is_damaged_and_not_without_any(tmp_path: Path) -> None:
    store, path = Store(tmp_path), tmp_path / "manifests" / "01.json"
    store.manifests.keep(manifest(*jobs("b", "a"), name="01"))
    kept = [line for line in path.read_text().splitlines(True) if not line.startswith('"a": ')]
    path.write_text("".join(kept))
    with pytest.raises(OSError, match="the list of records of a is not what was stored"):
        store.manifests.records_of("01", "a")


def test_what_is_damaged_is_passed_over_with_a_word(tmp_path: Path) -> None:
    store = Store(tmp_path)
    said: list[str] = []
    for name in ("01", "02"):
        store.manifests.keep(manifest(*jobs("a"), name=name))
    path = tmp_path / "manifests" / "01.json"
    path.write_text(path.read_text().replace('"solve_cpu": 0.0001', '"solve_cpu": 0.0002'))
    assert [one.name for one in store.manifests.newest(5, said.append)] == ["02"]
    assert said == [
        "past run 01: not a complete manifest: its content is not what was stored: the digest "
        "differs; skipped"
    ]
    assert history(store, "a", said.append)[0].name.startswith("c0ffee")
    assert said[1:] == [
        "past run 01: not a complete manifest: the list of records of a is not what was stored: "
        "the digest differs; skipped"
    ]
    path.with_name("02.json").unlink()
    assert history(store, "a", said.append) == []
    assert "the list of records of a" in said[1]
    assert store.manifests.latest() is None


def test_the_latest_run_is_no_copy_and_none_of_the_future(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store, folder = Store(tmp_path), tmp_path / "manifests"
    true, future = "20260101T000000.000000Z-1", "20990101T000000.000000Z-1"
    store.manifests.keep(manifest(*jobs("a"), name=true))
    store.manifests.keep(manifest(*jobs("b"), name=future))
    copy = "20260201T000000.000000Z-1"
    (folder / f"{copy}.json").write_bytes((folder / f"{true}.json").read_bytes())
    latest = store.manifests.latest()
    assert latest is not None
    assert latest.name == true
    said = capsys.readouterr().err
    assert f"past run {future}: it is dated in the future; skipped" in said
    assert (
        f"past run {copy}: not a complete manifest: its first line is not what was stored" in said
    )


@pytest.mark.parametrize("field", ["variant", "code"])
def test_a_record_of_what_is_not_described_is_no_part_of_a_whole_manifest(
    tmp_path: Path, field: str
) -> None:
    """Sealed as it is, it would end every report of this store for ever."""
    store, named = Store(tmp_path), manifest(*jobs("a"), name="01")
    store.manifests.keep(changed(named, records=[changed(named.records[0], **{field: "other"})]))
    with pytest.raises(OSError, match="other"):
        store.manifests.read("01")
    store.manifests.keep(changed(named, cases={}))
    with pytest.raises(OSError, match="a:T1, not described there"):
        store.manifests.read("01")


def test_a_record_names_no_file_outside_the_store() -> None:
    data = codec.to_data(jobs("a")[0])
    for key in ("../../x/victim", "/tmp/victim", "..", "a/b", "a.b", "a\\b", "a\n"):
        with pytest.raises(
            ValueError, match=r"Record\.key = .*; it must consist of letters, digits"
        ):
            codec.read(Record, {**data, "key": key}, "record")
    for key in ("", "0af3", "fall-up"):
        assert codec.read(Record, {**data, "key": key}, "record").key == key


HOSTILE: tuple[object, ...] = (
    None, "", 10**400, 1e300, -1, ["x"], {"x": 1}, "<script>alert(1)</script>", "\x1b[31m\x00",
    "no-such-word", json.loads("[" * 200 + "]" * 200),
)  # fmt: skip


def test_no_field_of_a_manifest_can_break_what_reads_it(tmp_path: Path) -> None:
    """Sealed anew each time, as by somebody who means harm: it is whole, or named as damaged."""
    made = manifest(*jobs("a"), name="01")
    data = codec.to_data(made)
    texts = []
    for place in places(data):
        for value in HOSTILE:
            changed = copy.deepcopy(data)
            functools.reduce(lambda part, step: part[step], place[:-1], changed)[place[-1]] = value
            texts.append(changed)
    assert len(texts) > 300
    for changed in texts:
        try:
            found = codec.read(type(made), codec.parse(json.dumps(changed)), "manifest")
        except ValueError:
            continue
        assert codec.parse(codec.render(found)) is not None
    with pytest.raises(ValueError, match="nested"):
        codec.parse("[" * 100_000 + "]" * 100_000)
    for number in ("1e999", "-1e999", "NaN", "9" * 400):
        with pytest.raises(ValueError, match=r"finite|whole"):
            codec.read(tuple[float, ...], codec.parse(f"[{number}]"), "numbers")


def places(data: object, above: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The ways to all that is in plain data."""
    parts = data.items() if isinstance(data, dict) else enumerate(data)  # type: ignore[arg-type]
    for step, part in parts:
        yield (*above, step)
        if isinstance(part, dict | list):
            yield from places(part, (*above, step))


@pytest.mark.parametrize("layer", ["records", "runs", "timings", "answers"])
def test_every_damaged_file_is_named_and_its_job_run_again(tiny: Tiny, layer: str) -> None:
    words = ("run", "--all", "--codes", "fake/good", "--json", "out.json")
    assert tiny.vv(*words).returncode == 0
    told = quantities(tiny)
    damaged = [
        *(tiny.root / ".vv" / layer).rglob("*.json"),
        *(tiny.root / ".vv" / layer).rglob("*.npz"),
    ]
    assert damaged
    if layer == "runs":  # which nobody reads as long as there are records
        shutil.rmtree(tiny.root / ".vv" / "records")
    if layer == "timings":  # which nobody reads as long as the invocation stands
        shutil.rmtree(tiny.root / ".vv" / "answers")
    for path in damaged:
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 1
        path.write_bytes(content)
    done = tiny.vv(*words)
    assert done.returncode == 0, done.stderr
    lost = [path for path in damaged if f"{path}: " not in done.stderr]
    if layer == "answers":  # of which only that of this invocation is asked for, and its report's
        assert len(lost) < len(damaged)
    elif layer == "records":  # each is two files, of which the first is named
        assert len(lost) <= len(damaged) / 2
    else:
        assert not lost
    assert "the digest differs; it is ignored and made again" in done.stderr
    assert quantities(tiny) == told
    assert "digest differs" not in tiny.vv(*words).stderr


def quantities(tiny: Tiny) -> list[Any]:
    """What the last run wrote of each record's quantities."""
    records = json.loads((tiny.root / "out.json").read_text())["records"]
    return [record["quantities"] for record in records]


def resealed(path: Path, **changes: np.ndarray) -> bytes:
    """What a file of arrays holds with changes of some, sealed as it was."""
    name = f"{path.parents[1].name}/{path.stem}"
    buffer = io.BytesIO()
    np.savez(buffer, **{**arrays_in(opened_bytes(name, path.read_bytes())), **changes})
    return sealed_bytes(name, buffer.getvalue())


@pytest.mark.parametrize("name", ["y.value", "y.reference"])
def test_a_series_that_is_not_that_of_its_figures_is_made_again(tiny: Tiny, name: str) -> None:
    """Sealed as it is: its curve would stand beside an error that is another's."""
    words = (*SELECTION, "--json", "out.json")
    assert tiny.vv(*words).returncode == 0
    told = quantities(tiny)
    forged = sorted((tiny.root / ".vv" / "records").rglob("*.npz"))
    for path in forged:
        path.write_bytes(resealed(path, **{name: np.linspace(0.0, 2.0, 11)}))
    done = tiny.vv(*words)
    assert done.returncode == 0
    assert sum(f"{path}: " in done.stderr for path in forged) == len(forged)
    assert quantities(tiny) == told
    assert "ignored" not in tiny.vv(*words).stderr


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"t": np.linspace(0.0, 1.0, 7)}, "reported 7 of 11 output times"),
        (
            {"value0": np.ones((11, 2))},
            "was asked in shape (11, 3) and reported with shape (11, 2)",
        ),
        ({"value0": np.full((11, 3), np.nan)}, "displacement of body 0 is not finite"),
        ({"value0": np.full((11, 3), "7")}, "value0 holds no numbers"),
    ],
)
def test_a_stored_run_that_answers_no_ask_is_run_again(
    tiny: Tiny, changes: dict[str, np.ndarray], said: str
) -> None:
    """Sealed as it is, it would be red for ever."""
    words = (*SELECTION, "--json", "out.json")
    tiny.vv(*words)
    told = quantities(tiny)
    for path in (tiny.root / ".vv" / "runs").rglob("*.npz"):
        path.write_bytes(resealed(path, **changes))
    for layer in ("answers", "records"):  # as long as they are there nobody reads runs
        shutil.rmtree(tiny.root / ".vv" / layer)
    done = tiny.vv(*words)
    assert (done.returncode, said in done.stderr) == (0, True), done.stderr
    assert quantities(tiny) == told


def test_a_record_that_leaves_a_quantity_out_is_made_again(tiny: Tiny) -> None:
    """Sealed as it is, the gate would be green for ever: of what is left out nothing is judged."""
    words = (*SELECTION, "--json", "out.json")
    tiny.vv(*words)
    told = quantities(tiny)
    shutil.rmtree(tiny.root / ".vv" / "answers")
    store = Store(tiny.root / ".vv")
    for one in (tiny.root / ".vv" / "records").rglob("*.json"):
        summary = store.summary(one.stem)
        assert summary is not None
        store.keep_summary(one.stem, dataclasses.replace(summary, quantities=()), {})
    done = tiny.vv(*words)
    assert "does not have all quantities; it is ignored and made again" in done.stderr
    assert quantities(tiny) == told


def test_a_lost_series_is_made_again(tiny: Tiny) -> None:
    words = (*SELECTION, "--json", "out.json")
    tiny.vv(*words)
    told = quantities(tiny)
    next((tiny.root / ".vv" / "records").rglob("*.npz")).unlink()
    shutil.rmtree(tiny.root / ".vv" / "answers")
    tiny.vv(*words)
    assert quantities(tiny) == told
