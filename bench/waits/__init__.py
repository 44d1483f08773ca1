"""How long a user waits for `vv`, and whether what it says of cost can be trusted."""
