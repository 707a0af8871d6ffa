"""Read a cloud: python examples/01_read_cloud.py [CLOUD]. Without one, a simulated frame is made first."""

import sys
import tempfile

import numpy as np

import boxwright
from boxwright.simulation import write_set

with tempfile.TemporaryDirectory() as folder:
    if len(sys.argv) > 1:
        path = sys.argv[1]
    else:
        [name] = write_set(folder, count=1, seed=1, categories=["medium"])
        path = f"{folder}/{name}.pcd"
    cloud = boxwright.read_cloud(path)  # metres, in the file's own frame; unit="mm" or frame="opengl" where it is so

print(f"{cloud.width} x {cloud.height} points, {'organized' if cloud.organized else 'unorganized'}")
readings = cloud.points[np.isfinite(cloud.points).all(axis=1)]  # points (N, 3) float32; NaN marks no reading
print(f"{len(readings)} readings, from {readings.min(axis=0).round(2)} to {readings.max(axis=0).round(2)} m")
print(f"seen from {cloud.viewpoint}; colours: {cloud.colors is not None}")
if cloud.organized:
    u, v = cloud.width // 2, cloud.height // 2
    print(f"pixel ({u}, {v}) is point {v * cloud.width + u}: {cloud.points[v * cloud.width + u].round(3)} m")
