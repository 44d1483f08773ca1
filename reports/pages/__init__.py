"""The contents of each page as frozen data, which the templates lay out."""
