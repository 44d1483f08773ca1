"""Benchmarks, in folders by what they show: each prints figures as JSON, exits 1 below its bar."""
