"""Packs of many spheres, whose ways are chance: how laws scatter, and when codes part."""
