"""Scenes that several tests use, and second routes to what happens in them."""
