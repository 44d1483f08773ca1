"""What the gate, the tests and the cases see of mistakes that are put in on purpose."""
