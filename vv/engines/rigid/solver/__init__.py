"""The contact solver: exact Coulomb friction by sweeps and by Newton steps with banded systems."""
