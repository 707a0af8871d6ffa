"""The paper's claims, each measured by one module: `python -m benchmarks.experiments NAME`, or `make experiments`."""
