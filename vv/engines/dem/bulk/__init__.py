"""Many free spheres and walls at rest, kept cell by cell so that steps read memory in order."""
