"""Claims about adapters/liggghts/."""
