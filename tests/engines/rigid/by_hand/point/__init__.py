"""Claims about the model of a point mass of `rigid`, one kernel at a time and in whole runs."""
