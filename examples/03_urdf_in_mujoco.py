"""A model as URDF, loaded in MuJoCo: a body for each panel, the flaps set to the measured angles."""

import tempfile
from pathlib import Path

import mujoco

import boxwright
from boxwright.kinematics import configuration
from boxwright.simulation import make_frame

frame = make_frame("medium", seed=3)
cloud = boxwright.Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
objects = [found for found in boxwright.infer(cloud).model.objects if found.pose is not None]
print(f"{len(objects)} objects with a pose")

with tempfile.TemporaryDirectory() as folder:
    for number, found in enumerate(objects):
        path = Path(folder) / f"box_{number}.urdf"
        boxwright.save_urdf(found, path, board_g_per_m2=550.0)
        spec = mujoco.MjSpec.from_file(str(path))
        spec.compiler.fusestatic = False  # every panel stays a body of its own
        model = spec.compile()
        data = mujoco.MjData(model)
        for joint, position_rad in configuration(found).items():  # URDF has no place for what was measured
            data.joint(joint).qpos[0] = position_rad
        mujoco.mj_kinematics(model, data)
        print(f"box {number}: {model.nbody - 1} bodies, {model.njnt} hinges, {1000 * model.body_mass.sum():.0f} g")
        for body in range(1, model.nbody):
            print(f"   {model.body(body).name} at {data.xpos[body].round(3)} m, in the object's frame")
