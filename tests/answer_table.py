"""Rewrites the stored answers of schemes to all cases that have them, without running a case.

For a change of a code that many cases see; of one case `vv accept` writes it.
"""

from pathlib import Path

from vv.gate import answers
from vv.plan.project import find

if __name__ == "__main__":
    project = find(Path(__file__))
    for name in project.case_names():
        if answers.accepted(project, name) is not None:
            answers.accept(project, name)
