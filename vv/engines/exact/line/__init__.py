"""Exact motion of one unknown on one spring contact, in closed form from event to event."""
