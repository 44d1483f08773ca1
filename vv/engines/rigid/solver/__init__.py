"""The contact solver: exact Coulomb friction by sweeps, banded systems, Newton steps."""
