"""Pages on cases and codes, made of what these declare, in Markdown."""
