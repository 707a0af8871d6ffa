"""Several looks at one scene from known places: one model that knows what each look hides."""

import math

import boxwright
from boxwright.simulation import make_looks

# A camera on an arm looks three times; boxwright.read_poses("looks.toml") lists the files and poses of real frames.
frames = []
for look in make_looks("carton", seed=3001, index=3, views=3, boxes=1):
    shown = look.frame
    cloud = boxwright.Cloud(points=shown.points, width=shown.width, height=shown.height, viewpoint=(0.0, 0.0, 0.0))
    frames.append(boxwright.PosedCloud(cloud=cloud, base_from_camera=look.base_from_camera))

for number in range(1, len(frames) + 1):
    fused = boxwright.infer_frames(frames[:number])
    print(f"{number} frame{'s' if number > 1 else ''}, {1000 * fused.model.seconds.total:.0f} ms")
    for found in fused.model.objects:
        for joint in found.joints:
            if joint.sigma is not None:
                degrees, sigma = math.degrees(joint.position), math.degrees(joint.sigma.position)
                print(f"   {joint.child}: {degrees:.1f} degrees open, give or take {sigma:.1f}")
        for part in found.parts:
            if part.seen_from is not None:
                print(f"   {part.name} is hidden; it would be seen from", [round(x, 2) for x in part.seen_from])
