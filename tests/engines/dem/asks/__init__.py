"""Claims about what DEM does with an ask before and after it is solved."""
