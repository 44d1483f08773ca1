"""Claims about the cases of steps and how long they stay stable."""
