"""Claims about the references of what strains a code."""
