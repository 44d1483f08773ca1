"""Independent second routes to the references of the family `hard`."""
