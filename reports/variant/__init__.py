"""What the part of a variant in a case's page shows, as frozen data that the templates lay out."""
