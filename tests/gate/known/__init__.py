"""Claims about known disagreements: their bands, their dates, known breaches of laws."""
