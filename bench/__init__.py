"""Benchmarks, in folders by topic: each prints figures as JSON, and exits with 1 below its bar."""
