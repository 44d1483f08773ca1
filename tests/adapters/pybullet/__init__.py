"""Claims about adapters/pybullet/."""
