"""One body that slips along a line on rigid contact, followed from event to event."""
