"""Second routes to the references of what strains a code."""
