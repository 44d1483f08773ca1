"""Claims about the contact solver of `rigid`, one kernel at a time."""
