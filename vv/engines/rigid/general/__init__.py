"""The general model: blocks that translate and rotate, in steps that are divided at events."""
