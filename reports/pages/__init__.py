"""What each page of a report shows, as frozen data that the templates lay out."""
