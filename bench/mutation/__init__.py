"""Measures how many deliberate mistakes the gate, the tests and the cases detect."""
