"""Claims about adapters/kratos/."""
