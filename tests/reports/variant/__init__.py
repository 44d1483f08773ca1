"""Claims about reports/variant/."""
