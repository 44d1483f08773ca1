"""Steps of second order for one body on a rigid wall whose slip changes direction."""
