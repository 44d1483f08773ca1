"""Pictures of scenes: the direction of view, the shapes to draw, and which of them move."""
