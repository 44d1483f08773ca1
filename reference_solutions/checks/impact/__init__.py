"""Second, independent solutions for the references of `reference_solutions.impact`."""
