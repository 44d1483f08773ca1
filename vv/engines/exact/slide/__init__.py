"""Exact motion of one body that slips along a line on rigid contact, from event to event."""
