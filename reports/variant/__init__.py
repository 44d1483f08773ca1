"""The contents of a variant's part of a page as frozen data, which templates lay out."""
