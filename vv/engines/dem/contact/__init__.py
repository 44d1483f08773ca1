"""How surfaces that touch act on each other: the law of contacts, and what it is told of them."""
