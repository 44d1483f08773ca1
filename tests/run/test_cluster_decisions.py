"""Claims about what head and workers of a cluster decide; no scheduler is needed to ask them."""

from __future__ import annotations

import multiprocessing
import socket
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from vv.ask import Run, Status
from vv.base.errors import UsageError
from vv.plan import imports
from vv.plan.project import Project
from vv.run.cluster import head, worker
from vv.run.pace import Pace
from vv.run.process import Batch

HERE = Path("/a/project")


def task(code: str = "dem", root: Path | None = HERE, programs: tuple[Path, ...] = ()) -> Any:
    """A task without asks."""
    return worker.Task(root, programs, code, "as the head has it", "default", (7, 8), (), 0.0)


@pytest.mark.parametrize(
    ("own", "daemon", "said"),
    [
        ("as the head has it", False, ""),
        ("another", False, "the sources, libraries or programs of dem are not those of the head"),
        ("another", True, "the sources, libraries or programs of dem are not those of the head"),
        ("as the head has it", True, "a worker must start processes"),
        (UsageError("no code 'dem'"), False, "no code 'dem'; a worker holds one project"),
    ],
)
def test_a_worker_says_why_it_cannot_run_a_code(
    own: str | UsageError, daemon: bool, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def digest(root: Path | None, programs: tuple[Path, ...], code: str) -> str:
        if isinstance(own, UsageError):
            raise own
        return own

    monkeypatch.setattr(worker, "_digest", digest)
    process = SimpleNamespace(daemon=daemon)
    monkeypatch.setattr(multiprocessing, "current_process", lambda: process)
    why = worker._why_not(task())
    assert why.startswith(said)
    assert bool(why) is bool(said)


def test_a_worker_that_cannot_run_a_code_fails_its_asks_and_times_the_other_codes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(worker, "_why_not", lambda one: "it is gone" if one.code == "dda" else "")
    monkeypatch.setattr(worker, "_batch", lambda one: one.code)
    monkeypatch.setattr(worker, "rounds", lambda batches, *_: list(batches))
    monkeypatch.setattr(socket, "gethostname", lambda: "host")
    failed = [(n, run.status, run.reason) for n, run in worker.answer(task("dda"), 1.0)]
    assert failed == [(n, Status.ERROR, "host: it is gone") for n in (7, 8)]
    seen: Any = worker.measure([task("dem"), task("dda")], 1.0)
    assert seen == (["dem"], ["host: it is gone"])


@pytest.mark.parametrize("bundled", [True, False])
def test_a_task_is_of_its_project_or_of_what_came_with_vv(
    bundled: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    program = (tmp_path / "mine.toml").resolve()
    found = worker._project(task(root=tmp_path, programs=(program,)))
    assert found == Project(tmp_path, programs=(program,))
    monkeypatch.setattr(imports, "OWN", tmp_path)
    monkeypatch.setattr(imports, "BUNDLE", tmp_path if bundled else tmp_path / "else")
    own = worker._project(task(root=None, programs=(program,)))
    assert own == Project(tmp_path, bundled=bundled, programs=(program,))
    for root, sent in ((tmp_path, None), (tmp_path / "other", tmp_path / "other")):
        place = head.Cluster("dask://there:1", Project(root), {"dem": "d"}, {})
        batch = SimpleNamespace(
            adapter=SimpleNamespace(name="dem"), scheme="s", numbers=(1,), asks=(), repeat=0.0
        )
        assert place._task(batch).root == sent  # type: ignore[arg-type]


def test_a_reason_that_names_a_folder_of_the_worker_holds_the_log_instead(tmp_path: Path) -> None:
    (tmp_path / "worker.log").write_text("a\nb\nc\nd\n")
    said = worker._with_log(Run(Status.ERROR, f"it died; see {tmp_path}")).reason
    assert said.startswith("it died; ")
    assert said.endswith("d")
    assert str(tmp_path) not in said
    plain = Run(Status.ERROR, "it died")
    assert worker._with_log(plain) is plain


class Client:
    """A connection to workers with these resources; it answers at once, or with an error."""

    def __init__(self, *resources: list[str], answer: object = None) -> None:
        self.resources, self.answer = resources, answer

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        """Nothing is held."""

    def nthreads(self) -> list[list[str]]:
        """One entry for each worker."""
        return [*self.resources]

    def run(self, what: object, on_error: str) -> dict[int, list[str]]:
        """The resources of each worker."""
        return dict(enumerate(self.resources))

    def submit(self, what: object, *given: object, **how: object) -> Any:
        """A future of the answer."""

        def result() -> object:
            if isinstance(self.answer, Exception):
                raise self.answer
            return self.answer

        return SimpleNamespace(result=result)


def connected(client: Client, monkeypatch: pytest.MonkeyPatch) -> tuple[head.Cluster, list[str]]:
    """A cluster of these workers, and the notices it gives."""
    said: list[str] = []
    monkeypatch.setattr(head, "notice", said.append)
    library = SimpleNamespace(Client=lambda place, timeout: client)
    monkeypatch.setattr(head, "_distributed", lambda: library)
    opened = SimpleNamespace(close=lambda: None)
    monkeypatch.setattr(socket, "create_connection", lambda *_: opened)
    monkeypatch.setattr(head, "machine", lambda: "this machine")
    monkeypatch.setattr(head, "rounds", lambda *_: ["timed here"])
    return head.Cluster("dask://there:1", Project(HERE), {}, {}), said


@pytest.mark.parametrize(
    ("resources", "by_a_worker"),
    [((), False), (([],), False), ((["gpu"], []), False), (([], ["gpu", "timing"]), True)],
)
def test_a_worker_times_if_one_has_a_machine_of_its_own_and_else_the_head(
    resources: tuple[list[str], ...], by_a_worker: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    place, said = connected(Client(*resources, answer="its machine"), monkeypatch)
    timer: Any = place.timer()
    assert timer == ("its machine" if by_a_worker else "this machine")
    waits = "dask://there:1 has no workers yet; jobs wait for the first"
    assert said == ([] if resources else [waits])
    answer = ["timed there"], ["dda: it is gone"]
    place, said = connected(Client(*resources, answer=answer), monkeypatch)
    timed: Any = place.timed([], 1.0)
    assert timed == (["timed there"] if by_a_worker else ["timed here"])
    assert ("not timed: dda: it is gone" in said) is by_a_worker


@pytest.mark.parametrize(
    ("start", "rest", "sizes"),
    [
        (0.0, (0.6,) * 8, [2, 2, 2, 2]),
        (0.0, (0.2, 0.3), [2]),
        (0.0, (7.0, 9.0), [1, 1]),
        (0.5, (1.2,) * 10, [2, 2, 2, 2, 2]),
        (2.0, (2.9,) * 6, [3, 3]),
    ],
)
def test_a_batch_takes_a_second_and_four_times_its_program_s_start(
    start: float, rest: tuple[float, ...], sizes: list[int]
) -> None:
    """Batches of no less than that by the sum of what is expected: at most one batch a job."""
    jobs: list[Any] = [SimpleNamespace() for _ in rest]
    begins = [0.0] * (len(rest) - 1) + [start]
    paces = {id(job): Pace(*one) for job, *one in zip(jobs, begins, rest, strict=True)}
    shares = list(head.Cluster("dask://there:1", Project(HERE), {}, paces).shares(jobs, 1))
    assert [len(share) for share in shares] == sizes
    assert sorted(place for share in shares for place in share) == list(range(len(rest)))


def test_a_session_that_dies_on_its_worker_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    place, said = connected(Client(["timing"], answer=OSError("cut")), monkeypatch)
    assert place.timed(list[Batch](), 1.0) == []
    assert said == ["nothing was timed: OSError: cut"]
