"""From a frame to a closed box: a place for the arm, a plan, and what physics makes of it."""

import math

import numpy as np

import boxwright
from boxwright.planning import place_robot
from boxwright.simulation import make_frame

frame = make_frame("medium", seed=3)
cloud = boxwright.Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
model = boxwright.infer(cloud).model

base_from_input = place_robot(model, "viper_s850")  # or where your arm stands: position (m), orientation (x, y, z, w)
print("the camera stands at", np.round(base_from_input.position, 2), "m in the arm's base frame")
plan = boxwright.plan_closing(model, "viper_s850", base_from_input)
for name, flap in plan.flaps.items():
    print(f"   {name}: {flap.status}", flap.reason or "")
print("closed in this order:", ", ".join(plan.order), f"in {plan.segments[-1].times[-1]:.0f} s")

run = boxwright.simulate(plan, model, frame.truth).simulation  # the true box, which the planner never saw
for name in plan.order:
    flap = run.flaps[name]
    print(f"   {name} rests at {math.degrees(flap.end_rad):.0f} degrees: {'closed' if flap.held else 'open'}")
print(f"the box slid {1000 * run.box_slid_m:.1f} mm; the arm pressed with at most {run.max_force_n:.1f} N")
