"""What tests share that is no scene: asks, made-up records, a tiny project."""
