"""Claims about the cases of stable steps."""
