"""Contact laws of spheres and walls, and the kinematics of a contact that they depend on."""
