"""Many free spheres and walls at rest, sorted by cells so that steps read memory in order."""
