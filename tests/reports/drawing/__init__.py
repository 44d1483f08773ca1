"""Claims about figures: maps, motion, phases, and comparisons with measurements."""
