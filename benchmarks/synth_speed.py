"""Frames a second of `boxwright synth`, drawing, ray casting and writing together.

Run: python benchmarks/synth_speed.py [COUNT]
"""

import sys
import tempfile
import time

from boxwright.simulation import CATEGORIES, write_set


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 36
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        write_set(folder, count, 1, CATEGORIES)
        seconds = time.perf_counter() - began
    print(f"{count} frames in {seconds:.2f} s: {count / seconds:.1f} frames a second")


if __name__ == "__main__":
    main()
