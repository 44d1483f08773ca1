"""The workflow files for GitHub and GitLab run what the Makefile offers, and the same."""

import re
import shutil
import subprocess

import pytest

from tests import ROOT

FILES = ("docs/ci/github.yml", "docs/ci/gitlab.yml")


def targets(file: str) -> list[str]:
    """The make targets that a workflow runs, in order."""
    return re.findall(r"^\s*- (?:run: )?make (\w+)$", (ROOT / file).read_text(), re.MULTILINE)


def test_both_run_the_same_targets_and_require_the_external_codes() -> None:
    assert targets(FILES[0]) == targets(FILES[1]) == ["test", "gate"]
    for file in FILES:
        assert "VV_REQUIRE: yade,liggghts" in (ROOT / file).read_text()


def test_both_keep_the_kernels_apart_from_results_and_from_pull_requests() -> None:
    github, gitlab = ((ROOT / file).read_text() for file in FILES)
    for text, root in ((github, "${{ github.workspace }}"), (gitlab, "$CI_PROJECT_DIR")):
        assert f"VV_CACHE: {root}/.kernels" in text
        assert re.search(r"^\s*(?:path:|-) \.kernels$", text, re.MULTILINE)
        assert "chmod -R go-w .kernels" in text
        assert not re.search(r"^\s*(?:path:|-) \.vv/?(numba)?$", text, re.MULTILINE)
    assert "if: github.event_name == 'push'\n        uses: actions/cache" in github
    assert "key: kernels-$CI_COMMIT_REF_PROTECTED" in gitlab


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
