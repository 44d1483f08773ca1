"""Claims about setup.sh: what stands is left alone, and what cannot be had is said plainly."""

import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

import pytest

from tests import ROOT

TOOLS = ("bash", "cat", "cmp", "dirname", "flock", "id", "mktemp", "rm", "sed", "sleep", "xargs")
MISSING = "setup: {0} is missing and will be left out; to have it: sudo apt-get install {0}\n"


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A folder whose set-up is done, with a space in its name; no external code is in PATH."""
    root = tmp_path / "a checkout"
    venv.create(root / ".venv", with_pip=False, symlinks=True)
    for file in ("setup.sh", "requirements.lock", "pyproject.toml"):
        shutil.copy(ROOT / file, root)
    major, minor, *_ = sys.version_info
    (root / ".venv/made-for").write_text(f"{major} {minor} {root / '.venv'}\n")
    both = (root / "requirements.lock").read_text() + (root / "pyproject.toml").read_text()
    (root / ".venv/installed").write_text(both)
    (tmp_path / "bin").mkdir()
    for tool in TOOLS:
        if found := shutil.which(tool):
            (tmp_path / "bin" / tool).symlink_to(found)
    return root


def setup(checkout: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["bash", checkout / "setup.sh"],
        env={"PATH": str(checkout.parent / "bin"), **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=30,
    )


def program(checkout: Path, name: str, text: str = "") -> None:
    path = checkout.parent / "bin" / name
    path.write_text(f"#!/bin/bash\n{text}\n")
    path.chmod(0o755)


def test_a_second_call_does_nothing_and_says_nothing(checkout: Path) -> None:
    program(checkout, "yade")
    program(checkout, "liggghts")
    done = setup(checkout)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_without_apt_the_codes_are_left_out_and_named(checkout: Path) -> None:
    done = setup(checkout)
    assert done.returncode == 0
    assert done.stdout == MISSING.format("yade") + MISSING.format("liggghts")


@pytest.mark.parametrize("required", ["yade,liggghts", "liggghts, yade", "yade"])
def test_a_required_code_that_cannot_be_had_fails(checkout: Path, required: str) -> None:
    program(checkout, "liggghts")
    done = setup(checkout, VV_REQUIRE=required)
    assert done.returncode == 1
    assert "setup: yade is required (VV_REQUIRE) and missing" in done.stderr


def test_apt_is_asked_again_unless_it_knows_no_such_package(checkout: Path) -> None:
    asked = checkout.parent / "asked"
    program(checkout, "id", "echo 0")
    program(checkout, "env", 'shift; "$@"')
    program(checkout, "tail")
    program(checkout, "apt-get", f'echo "${{@: -1}}" >>"{asked}"; false')
    program(checkout, "apt-cache", '[ "$2" = yade ]')
    program(checkout, "touch", ': >"$1"')
    setup(checkout)
    assert asked.read_text().split() == ["update", "yade", "liggghts"]
    setup(checkout)
    assert asked.read_text().split()[3:] == ["update", "yade"]
    setup(checkout, VV_APT="no")
    assert len(asked.read_text().split()) == 5
    setup(checkout, VV_REQUIRE="liggghts")
    assert asked.read_text().split()[5:] == ["update", "yade", "liggghts"]


def test_an_old_python_is_refused_by_name(checkout: Path) -> None:
    program(checkout, "python-old", "exit 1")
    done = setup(checkout, PYTHON="python-old")
    assert done.returncode == 1
    assert "python-old is not Python 3.11 or newer" in done.stderr


def test_a_python_without_venv_says_what_to_install(checkout: Path) -> None:
    text = f'[[ $* == *ensurepip* ]] && exit 1; exec "{sys.executable}" "$@"'
    program(checkout, "python-bare", text)
    (checkout / ".venv/made-for").unlink()
    done = setup(checkout, PYTHON="python-bare")
    assert done.returncode == 1
    assert f"sudo apt-get install python3.{sys.version_info[1]}-venv" in done.stderr


def test_an_environment_made_elsewhere_is_made_anew(checkout: Path) -> None:
    moved = checkout.rename(checkout.parent / "moved")
    program(moved, "python3", 'echo "$*" >>"$HOME/calls"; exit 1')
    done = setup(moved, PYTHON="python3", HOME=str(moved))
    assert "setup: making .venv" in done.stdout
    assert "3, 11" in (moved / "calls").read_text()


def test_a_changed_lock_is_installed_without_making_the_environment_anew(checkout: Path) -> None:
    (checkout / "requirements.lock").write_text("nothing==1\n")
    done = setup(checkout)
    assert "setup: installing the packages of requirements.lock into .venv\n" in done.stdout
    assert "making" not in done.stdout
    assert "No module named pip" in done.stderr


@pytest.mark.parametrize("broken", [None, 0, 52])
def test_the_lock_is_installed_by_two_pips_and_stands_if_both_succeed(
    checkout: Path, broken: int | None
) -> None:
    asked, python = checkout.parent / "asked", checkout / ".venv/bin/python"
    names = [f"package-{n}==1" if n != broken else "broken==1" for n in range(53)]
    (checkout / "requirements.lock").write_text("\n".join(["# a comment", *names, ""]))
    python.rename(python.with_name("real"))
    pip = f'echo "$@" >>"{asked}"; [[ "$*" != *broken* ]]'
    python.write_text(
        f'#!/bin/bash\ncase "$1" in -m) {pip} ;; *) exec "${{0%/*}}/real" "$@" ;; esac\n'
    )
    python.chmod(0o755)
    done = setup(checkout)
    installs = [line.split() for line in asked.read_text().splitlines() if "--no-compile" in line]
    assert len(installs) == 2
    assert sorted(word for words in installs for word in words if "==" in word) == sorted(names)
    assert (done.returncode == 0) == (broken is None)
    stands = (checkout / ".venv/installed").read_text().startswith("# a comment")
    assert stands == (broken is None)


def test_ci_runs_the_tests_with_the_codes_required(tmp_path: Path) -> None:
    (tmp_path / ".ci").mkdir()
    shutil.copy(ROOT / ".ci/run", tmp_path / ".ci")
    (tmp_path / "bin").mkdir()
    make = tmp_path / "bin/make"
    make.write_text('#!/bin/bash\necho "$PWD $* $VV_REQUIRE $CI"; cat\n')
    make.chmod(0o755)
    path = f"{make.parent}:{os.environ['PATH']}"
    done = subprocess.run(
        [tmp_path / ".ci/run"], env={"PATH": path}, capture_output=True, text=True, check=True
    )
    assert done.stdout == f"{tmp_path} test yade,liggghts true\n"


def packaged(checkout: Path, fails: str = "") -> None:
    """A code that is a package; python3 makes its environment, in which pip fails as it says."""
    (checkout / "adapters/mine").mkdir(parents=True)
    (checkout / "adapters/mine/requirements.txt").write_text("mine==1.2\n")
    for name in ("yade", "liggghts"):
        program(checkout, name)
    for tool in ("grep", "tail", "tr"):
        (checkout.parent / "bin" / tool).symlink_to(str(shutil.which(tool)))
    pip = f'echo "$@" >>"{checkout.parent}/asked"; echo "{fails}"; [ -z "{fails}" ]'
    inner = f'case "$1" in -m) {pip} ;; *) exec "{sys.executable}" "$@" ;; esac'
    outer = (
        f'if [ "$2" = venv ]; then mkdir -p "$4/bin"; printf "%s" "$INNER" >"$4/bin/python"; '
        f'chmod +x "$4/bin/python"; else exec "{sys.executable}" "$@"; fi'
    )
    program(checkout, "python3", f"INNER='#!/bin/bash\n{inner}'\n{outer}")
    for tool in ("mkdir", "chmod"):
        (checkout.parent / "bin" / tool).symlink_to(str(shutil.which(tool)))


def test_a_code_that_is_a_package_gets_an_environment_of_its_own_once(checkout: Path) -> None:
    packaged(checkout)
    done = setup(checkout, CODES="mine")
    assert (done.returncode, done.stdout) == (0, "setup: installing mine into .codes/mine\n")
    asked = (checkout.parent / "asked").read_text()
    assert "--no-deps" in asked
    assert "adapters/mine/requirements.txt" in asked
    assert (checkout / ".codes/mine/installed").read_text() == "mine==1.2\n"
    assert setup(checkout, CODES="mine").stdout == ""


def test_a_package_that_no_python_fits_is_named_and_nothing_is_left(checkout: Path) -> None:
    packaged(checkout, "ERROR: no matching distribution")
    done = setup(checkout, CODES="mine")
    assert done.returncode == 1
    assert "setup: no mine for python3: ERROR: no matching distribution" in done.stdout
    assert "mine is not to be had: no Python here fits mine==1.2" in done.stderr
    assert not (checkout / ".codes/mine").exists()


def test_a_code_that_is_no_package_is_refused_with_those_there_are(checkout: Path) -> None:
    packaged(checkout)
    done = setup(checkout, CODES="nonsuch")
    assert (done.returncode, done.stderr) == (
        1, "setup: CODES has 'nonsuch'; there are: mine\n",
    )  # fmt: skip
