"""Claims about how asks are translated for programs, by hand and without the programs."""
