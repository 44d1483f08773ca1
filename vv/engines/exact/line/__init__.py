"""Exact motion of one unknown on one spring contact, in closed form between events."""
