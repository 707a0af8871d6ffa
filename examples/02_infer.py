"""From a frame to its boxes: which panel is which, where the hinges are, how far each flap is open."""

import math

import boxwright
from boxwright.simulation import make_frame

frame = make_frame("medium", seed=3)  # a simulated Kinect frame; boxwright.read_cloud(path) reads a real one
cloud = boxwright.Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
inferred = boxwright.infer(cloud)
print(f"{len(inferred.model.objects)} objects in {1000 * inferred.model.seconds.total:.0f} ms")

for number, found in enumerate(inferred.model.objects):
    print(f"{number}: {found.template}, score {found.score:.2f}")
    if found.dimensions is not None:  # too little may have been seen to tell
        print("   length, width, height:", ", ".join(f"{1000 * metres:.0f}" for metres in found.dimensions), "mm")
    for joint in found.joints:
        if found.part(joint.child).observed:
            print(f"   {joint.child} is open by {math.degrees(joint.position):.0f} degrees (0 closed, 180 flat)")
    points = int((inferred.object_labels == number).sum())
    print(f"   {points} of the frame's points lie on it")
