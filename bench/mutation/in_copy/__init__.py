"""Files that the copy with mutants has in vv/."""
