"""Claims about adapters/yade/."""
