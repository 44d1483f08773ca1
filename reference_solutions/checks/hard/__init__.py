"""Second routes to the references of the family `hard`."""
