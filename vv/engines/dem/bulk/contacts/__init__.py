"""The forces of pairs and walls that touch: data are gathered, forces computed and added."""
