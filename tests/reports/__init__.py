"""Claims about reports/."""
