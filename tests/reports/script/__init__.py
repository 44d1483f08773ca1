"""Claims about the script of the report's pages, on made-up numbers, in a browser."""
