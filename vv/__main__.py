"""The entry point: holds this process and its workers to one thread each, then runs the tool."""

import gc
import os

LIBRARIES = ("OMP", "OPENBLAS", "MKL", "NUMBA")
ALLOCATED = 1_000_000  # objects before garbage collection: most data stay in use


def main() -> None:
    """Run `vv`; the limits must be set before numpy is imported."""
    for library in LIBRARIES:
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")
    gc.set_threshold(ALLOCATED)
    from vv import cli

    try:
        cli.main()
    finally:
        gc.freeze()  # otherwise a million objects would be scanned just before the process ends


if __name__ == "__main__":
    main()
