"""Markdown pages on cases and codes, made from their declarations."""
