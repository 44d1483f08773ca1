"""Benchmarks: each prints and writes its figures as JSON and exits 1 below its bar."""
