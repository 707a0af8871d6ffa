"""A URDF of a six-axis arm in a few lines, as a user might have one."""

from __future__ import annotations

JOINT = """<joint name="j{k}" type="revolute"><origin xyz="{xyz}" rpy="{rpy}"/>
<parent link="l{parent}"/><child link="l{k}"/>
<axis xyz="{axis}"/><limit lower="-2.5" upper="2.5" effort="0" velocity="3"/></joint>"""
PLACES = (
    ("0 0 0", "0 0 0", "0 0 1"),
    ("0.05 0 0.3", "0 0 0.2", "0 1 0"),
    ("0 0 0.35", "0 0 0", "0 1 0"),
    ("0.04 0 0.02", "0.1 0 0", "0 0 1"),
    ("0 0.03 0.3", "0 0 0", "0 1 0"),
    ("0.02 0 0.05", "0 0 0", "0 0 2"),
)
SHAPES = {
    0: '<box size="0.2 0.2 0.1"/>',
    2: '<cylinder radius="0.05" length="0.3"/>',
    3: '<sphere radius="0.06"/>',
}


def chain_urdf() -> str:
    """Six joints j1 ... j6 from link l0 to l6, three links with a shape, and a flange 0.1 m beyond the last."""
    links = []
    for k in range(7):
        geometry = f"<geometry>{SHAPES.get(k)}</geometry>"
        shape = f'<collision><origin xyz="0 0 0.1" rpy="0.3 0 0"/>{geometry}</collision>'
        mass = '<inertial><mass value="2"/></inertial>'
        links.append(f'<link name="l{k}">{mass}{shape if k in SHAPES else ""}</link>')
    joints = [
        JOINT.format(k=k, parent=k - 1, xyz=xyz, rpy=rpy, axis=axis) for k, (xyz, rpy, axis) in enumerate(PLACES, 1)
    ]
    flange = (
        '<link name="flange"/><joint name="to_flange" type="fixed"><origin xyz="0 0 0.1" rpy="0 0 0.5"/>'
        '<parent link="l6"/><child link="flange"/></joint>'
    )
    return f'<robot name="mine">{"".join(links)}{"".join(joints)}{flange}</robot>'
