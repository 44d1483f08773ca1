"""The command line: the only place that puts the parts together and prints.

May import: base, scene, ask, case, codes, scaling, store, plan, records, gate, run, insight,
output, reports.
"""

from __future__ import annotations

import os
import signal
import sys
import traceback
from collections.abc import Callable
from typing import Annotated

import typer

from vv.base.errors import UsageError
from vv.cli import (
    baseline_commands,
    check_command,
    docs_command,
    export_command,
    gate_command,
    past_commands,
    query_commands,
    report_command,
    run_command,
    speed_command,
    start_commands,
)
from vv.output import terminal

BITS = (
    "Exit status, a sum of bits: 0 all is well; 1 accuracy or regression; 2 conservation; "
    "4 speed; 8 crash or divergence; 16 timeout; 32 incomplete: nothing ran, or a required code "
    "or result is missing; 64 an invalid command line, which is never combined with another bit. "
    "`vv run` and `vv gate` exit alike on the same results; `vv speed` uses 8, 16, 32 and 64 only."
)
app = typer.Typer(
    help="Verify contact mechanics codes: one benchmark, many codes, error and cost in a report.",
    epilog=BITS,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
)
CRASHED = 8  # the exit bit of a crash, vv.records.finding.Bit.CRASH
INTERRUPTED = 130  # the exit status that shells use for a program ended by Ctrl-C
GROUPS: dict[str, dict[str, Callable[..., None]]] = {
    "Run": {"run": run_command.run, "speed": speed_command.speed},
    "Look": {
        "list": query_commands.list_cases,
        "codes": query_commands.list_codes,
        "report": report_command.report,
        "explain": query_commands.explain,
        "runs": past_commands.runs,
        "diff": past_commands.diff,
        "history": past_commands.history,
        "papers": past_commands.papers,
    },
    "Judge": {
        "gate": gate_command.gate,
        "accept": baseline_commands.accept,
        "record": baseline_commands.record,
    },
    "Extend": {
        "new": start_commands.new,
        "init": start_commands.init,
        "check": check_command.check,
        "export": export_command.export,
        "docs": docs_command.docs,
    },
}


def _version(asked: bool) -> None:
    if asked:
        from vv import __version__

        terminal.say(f"vv {__version__}")
        raise typer.Exit


@app.callback()
def _general(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_version, is_eager=True, help="Show the version."),
    ] = False,
) -> None:
    pass


for group, commands in GROUPS.items():
    for name, command in commands.items():
        app.command(name, rich_help_panel=group)(command)


def _message(error: Exception) -> str:
    """The message for bad options or an error in a project's files; empty for a bug of vv."""
    from vv.plan.imports import raised_within

    parser = getattr(error, "format_message", None)
    return raised_within(error) if parser is None else str(parser()) or "a command is missing"


def _place(error: OSError) -> str:
    """The file that cannot be used, and the variable that names its folder."""
    if error.filename is None:  # as where no process can be started
        return "this machine"
    folders = {name: os.environ.get(name, "") for name in ("VV_DATA", "VV_CACHE")}
    path = f"{error.filename}/"
    named = [n for n, folder in folders.items() if folder and path.startswith(f"{folder}/")]
    return f"{error.filename}" + "".join(f" (from {name})" for name in named)


def main() -> None:
    """Run the command line; bad input gets one line and exit status 64, never a traceback.

    For an error in a project's own files, the calls in these files that led to it are shown.
    """
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends its workers as Ctrl-C does
    try:
        code = app(standalone_mode=False)
    except UsageError as error:
        code = terminal.print_error(str(error))
    except typer.Exit as stop:
        code = stop.exit_code
    except (typer.Abort, KeyboardInterrupt):
        code = INTERRUPTED
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # the reader of the output has gone
        code = 0
    except OSError as error:
        code = terminal.print_error(f"cannot use {_place(error)}: {error.strerror}")
    except Exception as error:
        if message := _message(error):
            code = terminal.print_error(*message.splitlines())
        else:
            traceback.print_exc()
            code = CRASHED  # not 1, the status of Python, which would mean accuracy
    if code == INTERRUPTED:  # the option parser returns it too
        terminal.print_error("interrupted; finished results are stored")
    sys.exit(code or 0)
