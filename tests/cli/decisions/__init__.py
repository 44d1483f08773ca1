"""Claims about what commands decide, asked of their functions without a process."""
