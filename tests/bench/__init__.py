"""Claims about bench/."""
