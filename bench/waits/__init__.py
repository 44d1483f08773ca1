"""Measures how long users wait for `vv`, and whether its costs can be trusted."""
