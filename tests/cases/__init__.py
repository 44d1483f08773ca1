"""Claims about cases/."""
