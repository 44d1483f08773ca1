"""Claims about `vv report`: a folder or one file, never in the place of something else."""

from tests.conftest import Tiny
from vv.records.finding import Bit


def ran(tiny: Tiny) -> None:
    """A run of one case in one code."""
    assert tiny.vv("run", "fall:up", "--codes", "fake/good", "--level", "quick").returncode == 0


def test_it_is_a_folder_that_may_lie_elsewhere_and_be_written_again(tiny: Tiny) -> None:
    ran(tiny)
    elsewhere = tiny.root / "elsewhere"
    for _ in range(2):
        done = tiny.vv("report", "--output", str(elsewhere))
        assert done.stdout == f"{elsewhere / 'index.html'}\n"
    assert (elsewhere / "case-fall.html").is_file()


def test_it_never_writes_among_what_is_no_report(tiny: Tiny) -> None:
    ran(tiny)
    for place, said in (
        ("cases", "already exists and is not a report"),
        ("one.html", "`--single '*'` makes one file"),
        ("nowhere/report", "there is no folder"),
    ):
        done = tiny.vv("report", "--output", str(tiny.root / place))
        assert (done.returncode, said in done.stderr) == (Bit.USAGE, True), done.stderr
    assert not (tiny.root / "cases" / "index.html").exists()


def test_one_file_of_a_selection(tiny: Tiny) -> None:
    ran(tiny)
    one = tiny.root / "one.html"
    done = tiny.vv("report", "--single", "f*", "--output", str(one))
    assert done.stdout == f"{one}\n"
    assert "<style>" in one.read_text()
    wrong = tiny.vv("report", "--single", "other")
    assert (wrong.returncode, "has no such case" in wrong.stderr) == (Bit.USAGE, True)
