"""Claims about how the general kernel of `rigid` divides steps, by script."""
