"""Claims about adapters/lmgc90/."""
