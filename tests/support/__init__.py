"""Helpers of tests other than scenes: asks, made-up records, a tiny project."""
