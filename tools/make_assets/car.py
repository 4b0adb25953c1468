"""A car-like robot that steers its front wheels and drives its rear wheels."""

import math

from mesh import Mesh
from robots import write_wheel
from sdf import box, collision, cylinder, inertial, link, material, mesh, pose, visual, write_model

BASE, TRACK, RADIUS, WIDTH = 0.46, 0.36, 0.085, 0.06  # m
LIMIT = 0.55  # maximum steering angle, rad
PAINT = (0.05, 0.28, 0.5)
# The outline of the body from the side, as (x, z). The origin is on the ground below the middle of
# the rear axle; the bonnet is to the right.
BODY = [(-0.13, 0.09), (0.59, 0.09), (0.61, 0.13), (0.59, 0.17), (0.44, 0.2), (-0.1, 0.21), (-0.13, 0.17)]
CABIN = [(-0.06, 0.205), (0.4, 0.2), (0.3, 0.3), (-0.01, 0.305)]
# The positions of the eight sonars, counter-clockwise from the front.
SONARS = [(0.61, 0), (0.58, 0.13), (0.23, 0.15), (-0.12, 0.13), (-0.13, 0), (-0.12, -0.13), (0.23, -0.15),
          (0.58, -0.13)]


def make(models):
    folder = models / "courier"
    extruded(BODY, 0.3).write(folder / "meshes" / "body.obj")
    extruded(CABIN, 0.24).write(folder / "meshes" / "cabin.obj")
    write_wheel(folder / "meshes", radius=RADIUS, width=WIDTH, spokes=6)
    write_model(
        folder,
        "A car-like robot of 74 by 42 cm. Origin on the floor below the middle of the rear axle, x ahead.",
        "Courier",
        "A car-like robot that steers its front wheels, with 8 sonars and a camera.",
        [chassis(), *wheels(), drive()],
        static=False,
    )


def extruded(outline, width):
    """Returns the solid with this outline in the plane of x and z, from y = -width / 2 to width / 2.

    The points (x, z) are counter-clockwise as seen from the right of the car.
    """
    solid = Mesh()
    half = width / 2
    solid.add_face([(x, -half, z) for x, z in outline], [(0, -1, 0)] * len(outline), outline)
    back = outline[::-1]
    solid.add_face([(x, half, z) for x, z in back], [(0, 1, 0)] * len(back), back)
    for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
        solid.add_quad([(x0, half, z0), (x1, half, z1), (x1, -half, z1), (x0, -half, z0)])
    return solid


def chassis():
    dark, glass = material((0.08, 0.08, 0.09), roughness=0.6), material((0.1, 0.13, 0.16), roughness=0.15)
    parts = [
        visual("body", mesh("body"), material(PAINT, roughness=0.35)),
        visual("cabin", mesh("cabin"), glass),
        visual("bumper", box(0.03, 0.32, 0.05), dark, (0.6, 0, 0.12)),
        visual("rear_axle", cylinder(0.012, TRACK), dark, (0, 0, RADIUS, math.pi / 2, 0, 0)),
        visual("front_axle", box(0.03, TRACK - 0.06, 0.025), dark, (BASE, 0, RADIUS)),
        visual("camera_mast", cylinder(0.012, 0.08), dark, (0.24, 0, 0.34)),
        visual("camera_body", box(0.05, 0.08, 0.045), dark, (0.24, 0, 0.4)),
        collision("body", box(0.74, 0.3, 0.12), (0.24, 0, 0.15)),
        collision("cabin", box(0.4, 0.24, 0.1), (0.17, 0, 0.255)),
        collision("camera", box(0.05, 0.08, 0.12), (0.24, 0, 0.365)),
    ]
    for side in (1, -1):
        lamp = material((1, 0.97, 0.85), roughness=0.2)
        parts.append(visual(f"lamp_{'left' if side > 0 else 'right'}", cylinder(0.025, 0.01), lamp,
                            (0.598, side * 0.1, 0.15, 0, math.pi / 2, 0)))
    for k, (x, y) in enumerate(SONARS):
        gold = material((0.9, 0.75, 0.3), roughness=0.4, metalness=0.4)
        parts.append(visual(f"sonar_{k:02d}_face", cylinder(0.014, 0.006), gold,
                            (x, y, 0.13, 0, math.pi / 2, math.radians(45 * k))))
    for k, (x, y) in enumerate(SONARS):
        parts.append(
            f'<sensor name="sonar_{k:02d}" type="sonar"><pose degrees="true">{x:.6g} {y:.6g} 0.13 0 0 {45 * k}'
            "</pose><sonar><min>0.05</min><max>4.0</max><radius>0.5</radius></sonar></sensor>")
    parts.append(
        f'<sensor name="camera" type="camera">{pose(0.27, 0, 0.4, 0, 0.08, 0)}<camera>'
        "<horizontal_fov>1.2</horizontal_fov><image><width>320</width><height>240</height>"
        "<format>R8G8B8</format></image><clip><near>0.05</near><far>50</far></clip></camera></sensor>")
    return link("base", parts, inertial=inertial(12, (0.7, 0.3, 0.15), (0.23, 0, 0.13)))


def wheels():
    """Returns the wheels, each on its own axle. The front wheels are on knuckles that turn about z."""
    parts = []
    for end, x in (("rear", 0.0), ("front", BASE)):
        for side, y in (("left", TRACK / 2), ("right", -TRACK / 2)):
            name, parent = f"{end}_{side}_wheel", "base"
            if end == "front":
                parent = f"{end}_{side}_knuckle"
                parts.append(link(parent, [visual("pin", cylinder(0.012, 0.05),
                                                  material((0.3, 0.3, 0.32), roughness=0.4))],
                                  (x, y, RADIUS), inertial(0.3, (0.05, 0.05, 0.05))))
                parts.append(joint(f"{end}_{side}_steering_joint", "base", parent, "0 0 1", LIMIT))
            parts.append(link(name, [
                visual("tyre", mesh("tyre"), material((0.07, 0.07, 0.08), roughness=0.9)),
                visual("hub", mesh("hub"), material((0.75, 0.76, 0.78), roughness=0.35, metalness=0.6)),
                collision("rim", cylinder(RADIUS, WIDTH)),
            ], (x, y, RADIUS, -math.pi / 2, 0, 0), inertial(0.5, (0.15, 0.15, WIDTH))))
            parts.append(joint(f"{name}_joint", parent, name, "0 0 1", 1e16))
    return parts


def joint(name, parent, child, axis, limit):
    return (f'<joint name="{name}" type="revolute"><parent>{parent}</parent><child>{child}</child><axis>'
            f"<xyz>{axis}</xyz><limit><lower>{-limit:g}</lower><upper>{limit:g}</upper></limit></axis></joint>")


def drive():
    return f"""<plugin filename="gz-sim-ackermann-steering-system" name="gz::sim::systems::AckermannSteering">
  <left_joint>rear_left_wheel_joint</left_joint>
  <left_joint>front_left_wheel_joint</left_joint>
  <right_joint>rear_right_wheel_joint</right_joint>
  <right_joint>front_right_wheel_joint</right_joint>
  <left_steering_joint>front_left_steering_joint</left_steering_joint>
  <right_steering_joint>front_right_steering_joint</right_steering_joint>
  <kingpin_width>{TRACK}</kingpin_width>
  <steering_limit>{LIMIT}</steering_limit>
  <wheel_base>{BASE}</wheel_base>
  <wheel_separation>{TRACK}</wheel_separation>
  <wheel_radius>{RADIUS}</wheel_radius>
  <min_velocity>-0.6</min_velocity>
  <max_velocity>1.5</max_velocity>
  <min_acceleration>-2.5</min_acceleration>
  <max_acceleration>1.5</max_acceleration>
</plugin>"""
