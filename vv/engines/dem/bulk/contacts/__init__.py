"""The forces of pairs and walls that touch: what they need is fetched, computed, handed out."""
