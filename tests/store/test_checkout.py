"""What git says of a checkout, whatever its files are called."""

from pathlib import Path

import pytest

from tests.conftest import Tiny
from vv.base.errors import UsageError
from vv.store.checkout import changed_since, commit, named

NAMES = ("plain.py", "größe.py", "with space.py", 'a "quote".py', "two\nlines.py")


@pytest.mark.parametrize("name", NAMES)
def test_a_file_of_any_name_is_seen_when_it_is_new_changed_or_deleted(
    tmp_path: Path, name: str
) -> None:
    tiny, path = Tiny(tmp_path), tmp_path / name
    tiny.git("init", "-q")
    tiny.git("commit", "-q", "--allow-empty", "-m", "first")
    path.write_text("one")
    assert changed_since(tmp_path, "HEAD") == {path}
    assert commit(tmp_path) == (named(tmp_path, "HEAD"), True)
    tiny.git("add", ".")
    tiny.git("commit", "-qm", "second")
    assert changed_since(tmp_path, "HEAD") == frozenset()
    assert commit(tmp_path) == (named(tmp_path, "HEAD"), False)
    assert changed_since(tmp_path, "HEAD~1") == {path}
    path.write_text("two")
    assert changed_since(tmp_path, "HEAD") == {path}
    path.unlink()
    assert changed_since(tmp_path, "HEAD") == {path}


def test_outside_a_checkout_there_is_no_commit(tmp_path: Path) -> None:
    assert commit(tmp_path) == ("", False)
    assert named(tmp_path, "HEAD") == ""
    with pytest.raises(UsageError, match="--since: git says"):
        changed_since(tmp_path, "HEAD")


def test_a_revision_is_never_an_option_of_git(tmp_path: Path) -> None:
    tiny, victim = Tiny(tmp_path), tmp_path / "victim"
    tiny.git("init", "-q")
    victim.write_text("kept")
    tiny.git("add", ".")
    tiny.git("commit", "-qm", "first")
    for hostile in (f"--output={victim}", f"-o{victim}", "--help", "HEAD\0", "-"):
        assert named(tmp_path, hostile) == ""
        with pytest.raises(UsageError, match="--since: git says"):
            changed_since(tmp_path, hostile)
    assert victim.read_text() == "kept"


def test_a_file_that_moved_is_seen_at_both_places_and_from_a_folder_of_the_checkout(
    tmp_path: Path,
) -> None:
    tiny, inner = Tiny(tmp_path), tmp_path / "inner"
    inner.mkdir()
    (inner / "old.py").write_text("one\n" * 50)
    (tmp_path / "outside.py").write_text("one")
    tiny.git("init", "-q")
    tiny.git("add", ".")
    tiny.git("commit", "-qm", "first")
    tiny.git("mv", "inner/old.py", "inner/new.py")
    (tmp_path / "outside.py").write_text("two")
    moved = {inner / "old.py", inner / "new.py"}
    assert changed_since(tmp_path, "HEAD") == {*moved, tmp_path / "outside.py"}
    assert changed_since(inner, "HEAD") == moved
