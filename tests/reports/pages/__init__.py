"""Claims about the pages of a report: what they gather and count."""
