"""What tests of adapters share: asks, the schemes of a code, what stands in for a code."""
