"""Claims about reference_solutions/."""
