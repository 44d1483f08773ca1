"""Claims about the references of hard cases."""
