"""Claims about the programs that codes start: how they are started, ended and quoted."""
