"""Claims about figures: maps, motion, phases, and what was measured beside them."""
