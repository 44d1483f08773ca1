"""Second routes to the answers of `reference_solutions.impact`."""
