"""The workflow files for GitHub and GitLab run what the Makefile offers, and the same."""

import re
import shutil
import subprocess

import pytest

from tests import ROOT
from vv.engines.kernels.compiled import cache_folder

FILES = ("docs/ci/github.yml", "docs/ci/gitlab.yml")


def targets(file: str) -> list[str]:
    """The make targets that a workflow runs, in order."""
    return re.findall(r"^\s*- (?:run: )?make (\w+)$", (ROOT / file).read_text(), re.MULTILINE)


def test_both_run_the_same_targets_and_require_the_external_codes() -> None:
    assert targets(FILES[0]) == targets(FILES[1]) == ["test", "gate"]
    for file in FILES:
        assert "VV_REQUIRE: yade,liggghts" in (ROOT / file).read_text()


def test_both_keep_the_kernels_where_a_checkout_has_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("VV_CACHE", raising=False)
    kept = (
        cache_folder(ROOT / "vv" / "engines" / "dem" / "line" / "kernel.py")
        .parent.relative_to(ROOT)
        .as_posix()
    )
    for file in FILES:
        assert re.search(rf"^\s*(?:path:|-) {re.escape(kept)}$", (ROOT / file).read_text(), re.M)


@pytest.mark.skipif(not shutil.which("make"), reason="make is not installed")
def test_the_gate_target_demands_baselines_and_required_codes_and_writes_what_ci_keeps() -> None:
    words = ["make", "-n", "-o", "setup", "gate", "VV_REQUIRE=yade,liggghts"]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True)
    command = " ".join(done.stdout.replace("\\\n", " ").split())
    assert "vv gate --against cases/baselines --require yade,liggghts" in command
    written = re.findall(r"--\w+ (\.vv/\S+)", command)
    assert len(written) == 2
    for file in FILES:
        assert all(name in (ROOT / file).read_text() for name in written)
