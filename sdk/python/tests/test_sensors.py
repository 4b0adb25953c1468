"""Tests sensors in Python: readings are numbers, and NumPy arrays that share memory with the
readings.
"""
import math

import numpy
import pytest

import gsv

# A box is ahead of a robot at the origin. Its near face is 2 m from the robot's centre.
WORLD = """<sdf version='1.9'><world name='w'><gravity>0 0 -9.8</gravity>
  <model name='wall'><static>true</static><pose>2.5 0 0.5 0 0 0</pose><link name='l'>
    <collision name='c'><geometry><box><size>1 8 1</size></box></geometry></collision>
    <visual name='v'><geometry><box><size>1 8 1</size></box></geometry>
      <material><diffuse>1 0 0 1</diffuse></material></visual>
  </link></model></world></sdf>"""


@pytest.fixture
def world(tmp_path):
    file = tmp_path / "world.sdf"
    file.write_text(WORLD)
    return str(file)


def in_run(simulate, world, prepare, look, model="pebble"):
    """Returns the result of `look` for the object that `prepare` made, after a tenth of a second."""
    seen, raised = [], []

    class Looking(gsv.Behaviour):
        def init(self, robot):
            self.prepared = prepare(robot)

        def run(self, robot):
            robot.sleep_for(0.1)
            try:
                seen.append(look(robot, self.prepared))
            except Exception as error:
                raised.append(error)

    simulation = simulate(world)
    simulation.add(model, behaviour=Looking)
    simulation.run_until(0.2)
    if raised:
        raise raised[0]
    return seen[0]


def test_sonar_measures_the_distance_to_the_wall(simulate, world):
    ahead = in_run(simulate, world,
                   lambda robot: robot.create(gsv.Sonar, "s", gsv.Placement(z=0.3), {"max": 3.0}),
                   lambda robot, sonar: (sonar.range(), sonar.max_range))
    assert ahead == (pytest.approx(2.0, abs=1e-6), 3.0)


def test_scan_is_a_view_of_its_reading(simulate, world):
    parameters = {"scan.horizontal.samples": 3.0, "scan.horizontal.min_angle": -math.pi / 3,
                  "scan.horizontal.max_angle": math.pi / 3}
    scan = in_run(simulate, world,
                  lambda robot: robot.create("lidar", "l", gsv.Placement(z=0.3), parameters),
                  lambda robot, lidar: lidar.ranges())
    assert scan.dtype == numpy.float64
    numpy.testing.assert_allclose(scan, [4.0, 2.0, 4.0], atol=1e-5)  # 2 / cos(60°)
    assert not scan.flags.owndata and isinstance(scan.base, gsv.Reading)
    assert scan.base.values.ctypes.data == scan.ctypes.data


def test_image_shows_the_red_wall(simulate, world):
    size = {"image.width": 64, "image.height": 48, "horizontal_fov": 1.0}
    image = in_run(simulate, world,
                     lambda robot: robot.create(gsv.Camera, "c", gsv.Placement(z=0.5), size),
                     lambda robot, camera: camera.take_image())
    assert image.shape == (48, 64, 3) and image.dtype == numpy.uint8
    assert not image.flags.owndata
    red, green, blue = image[24, 32]
    assert red > 60 and green < red / 2 and blue < red / 2


def test_depth_and_labels_are_images_of_numbers(simulate, world):
    size = {"image.width": 32, "image.height": 24, "horizontal_fov": 1.0}

    def prepare(robot):
        place = gsv.Placement(z=0.5)
        return (robot.create(gsv.DepthCamera, "d", place, size),
                robot.create(gsv.SegmentationCamera, "s", place, size))

    depth, (labels, names) = in_run(
        simulate, world, prepare, lambda robot, cameras: (cameras[0].take_depth(),
                                                          cameras[1].segment()))
    assert depth.shape == (24, 32) and isinstance(depth.base, gsv.Reading)
    assert depth[12, 16] == pytest.approx(2.0, abs=1e-3)
    assert labels.shape == (24, 32) and labels.dtype == numpy.uint32
    assert names[labels[12, 16] - 1] == "wall"


def test_temperatures_are_an_image_in_kelvins(simulate, world):
    size = {"image.width": 32, "image.height": 24}
    kelvins = in_run(simulate, world,
                     lambda robot: robot.create(gsv.ThermalCamera, "t", gsv.Placement(z=0.5), size),
                     lambda robot, camera: camera.take_temperatures())
    assert kelvins.shape == (24, 32) and isinstance(kelvins.base, gsv.Reading)
    assert kelvins == pytest.approx(288.15)


def test_normals_are_unit_vectors_towards_the_camera(simulate, world):
    size = {"image.width": 32, "image.height": 24}
    normals = in_run(simulate, world,
                     lambda robot: robot.create(gsv.NormalsCamera, "n", gsv.Placement(z=0.5), size),
                     lambda robot, camera: camera.take_normals())
    assert normals.shape == (24, 32, 3) and isinstance(normals.base, gsv.Reading)
    assert normals[12, 16] == pytest.approx((-1, 0, 0), abs=1e-3)


def test_poses_and_forces_have_named_members(simulate, world):
    def prepare(robot):
        return (robot.create("positioning", "p"), robot.create("imu", "i"),
                robot.create("odometry", "o"))

    place, motion, estimate = in_run(
        simulate, world, prepare,
        lambda robot, them: (them[0].locate(), them[1].read(), them[2].read()))
    assert (place.x, place.y, place.yaw) == pytest.approx((0, 0, 0))
    assert tuple(motion.specific_force) == pytest.approx((0, 0, 9.8), abs=1e-6)
    turn = motion.world_from_sensor
    assert (turn.w, turn.x, turn.y, turn.z) == pytest.approx((1, 0, 0, 0), abs=1e-9)
    assert (estimate.x, estimate.linear) == (0, 0)


def test_radio_sends_bytes(simulate, world):
    heard = []

    class Speaking(gsv.Behaviour):
        def init(self, robot):
            self.radio = robot.create(gsv.Radio, "radio")

        def run(self, robot):
            if robot.name == "speaker":
                self.radio.broadcast(b"\0 here")
                with pytest.raises(gsv.Refused, match="max_size"):
                    self.radio.send("listener", b"x" * 5000)
            robot.sleep_for(0.1)
            heard.extend((robot.name, each.sender, each.content) for each in self.radio.receive())

    simulation = simulate(world)
    simulation.add("pebble", y=-1, name="speaker", behaviour=Speaking)
    simulation.add("pebble", y=1, name="listener", behaviour=Speaking)
    simulation.run_until(0.2)
    assert heard == [("listener", "speaker", b"\0 here")]


def test_sensors_are_found_by_name_and_checked_by_type(simulate, world):
    def prepare(robot):
        of_type = {traits.name: traits.type for traits in robot.sensors()}
        assert of_type["sonar_00"] == "sonar"
        with pytest.raises(gsv.Refused, match="\"sonar_00\" is not of the class Camera"):
            robot.open("sonar_00", gsv.Camera)
        with pytest.raises(gsv.Refused, match="no sensor \"nose\""):
            robot.open("nose")
        with pytest.raises(gsv.Refused, match="min"):
            robot.create("sonar", "wrong", parameters={"min": 5.0, "max": 1.0})
        return robot.open("sonar_00", gsv.Sonar)

    sonar = in_run(simulate, world, prepare, lambda robot, sonar: sonar)
    assert sonar.name == "sonar_00" and sonar.traits.robot_from_sensor.yaw == 0
    assert sonar.traits.parameters["max"] > 1


def test_refusal_names_the_robot_once(simulate, world):
    def prepare(robot):
        with pytest.raises(gsv.Refused) as none:
            robot.open("nose")
        with pytest.raises(gsv.Refused) as unknown:
            robot.create("smell", "nose")
        return str(none.value), str(unknown.value)

    assert in_run(simulate, world, prepare, lambda robot, said: said) == (
        'pebble: the robot has no sensor "nose"', 'pebble/nose: there is no sensor type "smell"')


def test_reading_outlives_its_sensor(simulate, world):
    values = in_run(simulate, world, lambda robot: robot.open("sonar_00"),
                    lambda robot, sonar: sonar.measure().values)
    assert values.shape == (1,) and 1.5 < values[0] < 2
    values[0] = 7  # the array belongs to the caller
    assert values[0] == 7


def test_exchange_reads_all_open_sensors(simulate, world):
    def prepare(robot):
        robot.open("sonar_00")
        robot.create("positioning", "where")

    readings = in_run(simulate, world, prepare,
                      lambda robot, _: robot.exchange(0.0, 0.0, until=0.15))
    assert set(readings) == {"sonar_00", "where"}
    assert readings["where"].time == 0.15 and readings["where"].values.shape == (6,)


def test_radio_tag_measures_the_distance_to_its_anchor(simulate, world):
    measured = in_run(simulate, world,
                      lambda robot: robot.create(gsv.Ranging, "tag", gsv.Placement(z=0.3), {"anchor": "wall"}),
                      lambda robot, tag: (tag.distance(), tag.traits.type))
    assert measured == (pytest.approx(math.hypot(2.5, 0.2), abs=1e-6), "ranging")


def test_lidar_reads_intensities_if_its_parameter_is_set(simulate, world):
    def prepare(robot):
        scan = {"scan.horizontal.samples": 3.0, "scan.horizontal.min_angle": -0.1,
                "scan.horizontal.max_angle": 0.1}
        return (robot.create(gsv.Lidar, "plain", gsv.Placement(z=0.3), scan),
                robot.create(gsv.Lidar, "with", gsv.Placement(z=0.3), {**scan, "intensity_scale": 100.0}))

    plain, ranges, intensities, without = in_run(
        simulate, world, prepare,
        lambda robot, lidars: (lidars[0].ranges(), *lidars[1].read(), lidars[0].read()[1]))
    assert numpy.array_equal(ranges, plain) and without.shape == (0,)
    assert intensities.shape == (3,) and intensities[0] == pytest.approx(
        intensities[1] * math.cos(0.1), rel=1e-6)
