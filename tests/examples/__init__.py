"""The example programs work, and are as short as they are said to be."""
