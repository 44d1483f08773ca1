"""How a scene looks: from where it is seen, the shapes that are drawn, and what of them moves."""
