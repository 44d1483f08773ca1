"""The command that tests a code on tiny scenes before it runs any case: `vv check`."""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vv.ask import Run, Status
from vv.base.errors import UsageError
from vv.cli import options
from vv.output.terminal import note, say
from vv.plan.project import find
from vv.scene import Term

if TYPE_CHECKING:
    from vv.codes.adapter import Adapter, Scheme
    from vv.codes.tiny_scenes import TinyScene

WRONG, CRASHED, INCOMPLETE = 1, 8, 32  # exit bits, as vv.records.finding.Bit has them


def check(
    code: Annotated[str, typer.Argument(metavar="FILE.toml|CODE", help="The code to check.")],
    timeout: Annotated[float, typer.Option("--timeout", help="Seconds that a run may take.")] = 10,
) -> None:
    """Test a code on tiny scenes with known answers, and describe what is wrong."""
    from vv.plan.selection import named_adapters

    project, named = options.with_programs(find(), code)
    name = named[0].partition("/")[0]
    if name not in project.adapter_names():
        raise UsageError(f"no code '{code}'; name a TOML file, or a code that `vv codes` lists")
    adapter = named_adapters(project, [name])[name]
    found = adapter.found()
    if not found.installed:
        note(f"{name} is not installed: {found.how_to_install}")
        raise typer.Exit(INCOMPLETE)
    say(f"{name} {found.version}: {found.path}")
    scratch = Path(tempfile.mkdtemp(prefix="vv-check-"))
    status = 0
    for scheme in adapter.schemes:
        status |= _check_scheme(adapter, scheme, options.positive(timeout), scratch)
    if any(scratch.iterdir()):
        note(f"questions and answers of what failed: {scratch}")
    else:
        scratch.rmdir()
    raise typer.Exit(status)


def _check_scheme(adapter: Adapter, scheme: Scheme, timeout: float, scratch: Path) -> int:
    """Ask one scheme all tiny scenes that it declares; returns exit bits."""
    from vv.codes.tiny_scene_check import Answered, judged
    from vv.codes.tiny_scenes import tiny_scenes, unasked

    say(f"{adapter.name}/{scheme.name} claims to be {scheme.method.value}")
    status, known, before = 0, tiny_scenes(scheme), ""
    for number, tiny in enumerate(known, 1):
        runs = _answers(adapter, scheme, tiny, timeout, scratch)
        found = judged(scheme, tiny, runs)
        same = found.answered is Answered.FAILED and found.words == before
        say(f"  {tiny.name}: {'failed in the same way' if same else found.words}")
        before = found.words
        status |= {Answered.WRONG: WRONG, Answered.FAILED: CRASHED}.get(found.answered, 0)
        if found.answered is Answered.REFUSED and not _refused_unasked(adapter, scheme, tiny):
            terms = _names(tiny.scene.terms())
            say(f"    remove from its terms what it refuses; this scene has {terms}")
            status |= INCOMPLETE
        if runs[-1].status is Status.TIMEOUT and number < len(known):
            say(f"  {len(known) - number} not tested, since it gave no answer in {timeout:g} s")
            break
    missing = _names(unasked(scheme))
    if not known:
        say("  nothing to ask: it declares neither spheres nor blocks, or reports no motion")
    elif missing:
        say(f"  declared but not tested, since no tiny scene shows it: {missing}")
    return status


def _names(terms: Iterable[Term]) -> str:
    """Terms as the file of a program names them."""
    return ", ".join(sorted(term.name.lower().replace("_", "-") for term in terms))


def _refused_unasked(adapter: Adapter, scheme: Scheme, tiny: TinyScene) -> bool:
    """Whether a scheme says without a run that it refuses a tiny scene."""
    return adapter.refuses(tiny.asks(scheme)[0], scheme.name) is not None


def _answers(
    adapter: Adapter, scheme: Scheme, tiny: TinyScene, timeout: float, scratch: Path
) -> list[Run]:
    """The run at each time step, in order; after a timeout no more are asked."""
    from vv.records.checking import checked
    from vv.run.process import Batch
    from vv.run.runner import run_batches

    asks = tiny.asks(scheme)
    reason = adapter.refuses(asks[0], scheme.name)
    if reason is not None:
        return [Run(Status.REFUSED, reason)]
    batch = Batch(adapter, scheme.name, tuple(range(len(asks))), tuple(asks))

    def folder() -> Path:
        return Path(tempfile.mkdtemp(prefix=f"{tiny.name.replace(' ', '-')}-", dir=scratch))

    runs = {}
    with contextlib.closing(run_batches([batch], 1, timeout, folder)) as answers:
        for number, run in answers:
            runs[number] = checked(run, asks[number])
            if run.status is Status.TIMEOUT:
                break
    return [runs[number] for number in sorted(runs)]
