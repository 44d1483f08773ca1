"""Claims about what is shipped: the wheel runs anywhere, the archives are whole, the lock fits."""

import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import venv
import zipfile
from pathlib import Path

import pytest
from packaging.requirements import Requirement

from tests import ROOT
from tests.conftest import Tiny

CONTENT = ("adapters", "cases", "reference_solutions", "reports", "examples")
LOCK = (ROOT / "requirements.lock").read_text().splitlines()


def build(target: str, folder: Path) -> Path:
    words = [sys.executable, "-m", "hatchling", "build", "-t", target, "-d", str(folder)]
    subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
    (archive,) = folder.iterdir()
    return archive


def written(folder: str) -> set[str]:
    """The files below a folder of the checkout, as paths from its root."""
    files = (p for p in (ROOT / folder).rglob("*") if p.is_file())
    return {p.relative_to(ROOT).as_posix() for p in files if "__pycache__" not in p.parts}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build("wheel", tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def shipped(wheel: Path) -> set[str]:
    return set(zipfile.ZipFile(wheel).namelist())


@pytest.fixture(scope="module")
def elsewhere(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The programs of a fresh environment with the wheel, and with our own one's dependencies.

    They are linked in, all but .pth files and what is ours: the editable vv stays out.
    """
    place = tmp_path_factory.mktemp("elsewhere")
    venv.create(place, with_pip=False, symlinks=True)
    programs = place / "bin"
    pip = [sys.executable, "-m", "pip", "--python", str(programs / "python"), "install"]
    subprocess.run([*pip, "-qq", "--no-index", "--no-deps", str(wheel)], check=True)
    (packages,) = place.glob("lib/python*/site-packages")
    for library in Path(sysconfig.get_path("purelib")).iterdir():
        if (
            not re.match(r"_?vv\W|.*\.pth$", library.name)
            and not (packages / library.name).exists()
        ):
            (packages / library.name).symlink_to(library)
    return programs


def call(program: Path, *words: str, cwd: Path) -> str:
    """What a program prints, run where nothing of this checkout is in reach."""
    hidden = ("PYTHONPATH", "VV_PROJECT")
    done = subprocess.run(
        [program, *words],
        cwd=cwd,
        env={name: value for name, value in os.environ.items() if name not in hidden},
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_wheel_holds_the_tool_and_all_content_below_it(shipped: set[str]) -> None:
    content = {f"vv/_project/{file}" for folder in CONTENT for file in written(folder)}
    own = {file for file in shipped if not file.startswith("vv-")}
    assert own == content | written("vv")


@pytest.mark.parametrize(
    "file",
    [
        "vv/py.typed",
        "vv/_project/adapters/yade/inside/driver.py",
        "vv/_project/cases/contact/single_contact.py",
        "vv/_project/cases/disagreements.toml",
    ],
)
def test_what_is_no_module_or_not_imported_arrives_too(shipped: set[str], file: str) -> None:
    assert file in shipped


def test_the_report_s_templates_arrive(shipped: set[str]) -> None:
    for folder in ("templates", "assets"):
        assert any(re.match(rf"vv/_project/reports/{folder}/\w", file) for file in shipped)


def test_the_licence_arrives(shipped: set[str]) -> None:
    assert any(re.fullmatch(r"vv-.*\.dist-info/licenses/LICENSE", file) for file in shipped)


def test_the_source_archive_is_whole_and_holds_nothing_generated(tmp_path: Path) -> None:
    with tarfile.open(build("sdist", tmp_path)) as archive:
        held = {name.partition("/")[2] for name in archive.getnames()}
    folders = [*CONTENT, "vv", "tests"]
    ours = {file for folder in folders for file in written(folder)}
    assert ours <= held
    assert {"Makefile", "setup.sh", ".ci/run", "requirements.lock", "LICENSE"} <= held
    assert not [name for name in held if re.search(r"(^|/)(\.venv|\.vv|__pycache__|\.git)/", name)]


def test_the_wheel_s_own_files_run(elsewhere: Path, tmp_path: Path) -> None:
    printed = call(elsewhere / "python", "-c", "import vv; print(vv.__file__)", cwd=tmp_path)
    assert Path(printed.strip()).is_relative_to(elsewhere.parent)


def test_the_wheel_lists_its_cases_in_an_empty_folder(elsewhere: Path, tmp_path: Path) -> None:
    assert "single-contact" in call(elsewhere / "vv", "list", cwd=tmp_path)
    assert not list(tmp_path.iterdir())


def test_the_wheel_runs_an_in_house_case_in_an_empty_folder(
    elsewhere: Path, tmp_path: Path
) -> None:
    printed = call(
        elsewhere / "vv", "run", "single-contact:T1", "--codes", "exact/default", cwd=tmp_path
    )
    last = printed.splitlines()[-1]
    assert re.match(r"settings: [1-9]\d* pass; run: ", last)
    (report,) = re.findall("report: ([^;]*)", last)
    assert Path(report).is_relative_to(tmp_path / ".vv")
    assert "single-contact" in Path(report).read_text()


def test_the_wheel_runs_a_project_of_a_user_s_own_that_has_no_reports(
    elsewhere: Path, tiny: Tiny
) -> None:
    (tiny.root / "vv").mkdir()
    (tiny.root / "vv" / "__init__.py").write_text("raise ImportError('not the vv that runs')")
    printed = call(elsewhere / "vv", "run", "fall:up", "--codes", "fake/good", cwd=tiny.root)
    assert f"report: {tiny.root / '.vv'}" in printed.splitlines()[-1]


def test_the_fingerprint_of_a_code_in_the_wheel_covers_no_library(
    elsewhere: Path, tmp_path: Path
) -> None:
    script = (
        "from vv.base import closure; from vv.plan import keys, project\n"
        "found = project.find()\n"
        "files = closure.import_closure(found.adapter_files('dem'), keys.roots(found))\n"
        "for file in files: print(file)"
    )
    files = call(elsewhere / "python", "-c", script, cwd=tmp_path).splitlines()
    assert files
    assert not [file for file in files if "/site-packages/vv/" not in file]


def test_the_lock_pins_whatever_the_project_declares() -> None:
    pinned = dict(line.lower().split("==") for line in LOCK if not line.startswith("#"))
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    for text in [*project["dependencies"], *project["optional-dependencies"]["dev"]]:
        wanted = Requirement(text)
        assert wanted.specifier.contains(pinned[wanted.name]), text


def test_the_lock_holds_versions_only() -> None:
    pin = re.compile(r"[A-Za-z0-9_.-]+==[0-9][0-9a-z.+]*")
    assert not [line for line in LOCK if not (line.startswith("#") or pin.fullmatch(line))]
