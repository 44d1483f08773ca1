"""Groups jobs into batches: asks that one worker answers in order."""

from __future__ import annotations

from collections.abc import Mapping

from vv.plan.plan import Job, Plan
from vv.run.executor import Executor
from vv.run.process import Batch

MANY = 100  # a scheme with more jobs than these is worth a second process


def batches(waiting: Mapping[int, Job], plan: Plan, place: Executor) -> list[Batch]:
    """The batches of each scheme; the executor decides how many.

    The first batch of each engine is at the beginning: it compiles the kernels that the other
    schemes of the engine use. External programs follow, since they take longest; the batches of one
    code are adjacent, since a worker may stay with it. The other schemes of the engines are last;
    those with many jobs are divided, so that all processes stay busy until the end. Within a batch
    searches are last, so that one start of a program answers all asks that need no rounds.
    """
    groups: dict[tuple[str, str], list[int]] = {}
    for number, job in sorted(waiting.items(), key=lambda item: item[1].ask.search is not None):
        groups.setdefault((job.code, job.scheme), []).append(number)
    made = []
    begun: set[str] = set()
    for (code, scheme), numbers in groups.items():
        last = code in begun and not plan.found[code].files and len(numbers) > MANY
        begun.add(code)
        jobs = [waiting[number] for number in numbers]
        for share in place.shares(jobs, 1 if last else len(groups)):
            chosen = tuple(numbers[one] for one in share)
            asks = tuple(waiting[number].ask for number in chosen)
            stays = plan.found[code].worker_stays
            made.append(Batch(plan.adapters[code], scheme, chosen, asks, stays=stays))
    first = {batch.adapter.name: batch for batch in reversed(made)}

    def turn(batch: Batch) -> tuple[int, str]:
        name = batch.adapter.name
        if plan.found[name].files:
            return 1, name
        return (0 if first[name] is batch else 2), ""

    return sorted(made, key=turn)
