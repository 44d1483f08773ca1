"""Claims about the cases of impacts."""
