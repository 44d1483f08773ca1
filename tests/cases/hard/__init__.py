"""Claims about cases/hard/."""
