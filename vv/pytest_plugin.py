"""A plug-in of pytest: `--vv CASE --vv-code FILE.toml` makes a test of each variant and setting."""

from __future__ import annotations

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    """The options; without --vv the plug-in does nothing."""
    group = parser.getgroup("vv", "verification of contact mechanics codes")
    group.addoption("--vv", action="append", default=[], metavar="CASE", help="a case; repeatable")
    group.addoption("--vv-code", default="*", metavar="CODES", help="as --codes of `vv run`")
    group.addoption(
        "--vv-level",
        default="quick",
        metavar="LEVEL",
        help="as --level of `vv run`, but quick if not given",
    )
    group.addoption(
        "--vv-set", action="append", default=[], metavar="NAME=VALUE", help="as --set of `vv run`"
    )
    group.addoption(
        "--vv-rung", action="append", default=[], metavar="dt=..", help="as --rung of `vv run`"
    )
    group.addoption(
        "--vv-only", action="store_true", help="run these tests alone, and none of the project"
    )
    group.addoption("--vv-timeout", default=300.0, type=float, help="seconds that one job may take")


def pytest_ignore_collect(config: pytest.Config) -> bool | None:
    """Leave the project's own tests out if asked to; else pytest decides."""
    return True if config.getoption("--vv-only") else None


def pytest_collection_modifyitems(session: pytest.Session, items: list[pytest.Item]) -> None:
    """Add a test for each job that the options select; raises pytest.UsageError for bad ones."""
    if session.config.getoption("--vv-only") and not session.config.getoption("--vv"):
        raise pytest.UsageError("--vv-only: name the cases to run with --vv CASE")
    if session.config.getoption("--vv"):
        from vv.cli import job_tests

        items.extend(job_tests.tests(session))


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    """Say where the report is, if jobs were run."""
    if config.getoption("--vv"):
        from vv.cli import job_tests

        for report in job_tests.reports(config):
            terminalreporter.write_line(f"vv report: {report}")
