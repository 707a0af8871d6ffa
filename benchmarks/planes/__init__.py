"""The plane front end beside peers: frames, truth, scores, runs, tables. Run by benchmarks/front_end.py."""
