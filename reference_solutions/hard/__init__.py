"""References of what strains a code."""
