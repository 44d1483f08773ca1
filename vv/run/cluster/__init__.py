"""Batches answered by a dask cluster: what its head does, and what its workers do."""
