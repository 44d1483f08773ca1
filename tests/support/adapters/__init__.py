"""Helpers of tests of adapters: asks, the schemes of a code, substitutes for codes."""
