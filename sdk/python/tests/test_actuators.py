"""Tests lamps, grippers, speakers and microphones in Python."""
import math

import pytest

import gsv

CAN_AHEAD = """<sdf version='1.9'><world name='w'><include><uri>model://ground_plane</uri></include>
  <include><uri>model://can</uri><pose>1 0 0 0 0 0</pose></include></world></sdf>"""


def in_run(simulate, prepare, work, model="pebble", world="playground"):
    """Returns the result of `work`, which runs as a behaviour."""
    given, raised = [], []

    class Working(gsv.Behaviour):
        def init(self, robot):
            self.prepared = prepare(robot)

        def run(self, robot):
            try:
                given.append(work(robot, self.prepared))
            except Exception as error:
                raised.append(error)

    simulation = simulate(world)
    simulation.add(model, behaviour=Working)
    simulation.run_until(2)
    if raised:
        raise raised[0]
    return given[0]


def test_lamp_reports_its_command(simulate):
    def work(robot, lamp):
        lamp.set(gsv.Colour(1, 0.5, 0), 0.25)
        robot.sleep_for(0.05)
        glow = lamp.read()
        with pytest.raises(gsv.Refused, match="the brightness"):
            lamp.set(brightness=2)
        lamp.switch_off()
        robot.sleep_for(0.05)
        return glow, lamp.read()

    glow, after = in_run(simulate, lambda robot: robot.create(gsv.Lamp, "led"), work)
    assert (glow.brightness, *glow.colour) == (0.25, 1, 0.5, 0)
    assert after.brightness == 0


def test_speaker_plays_and_reports_the_remaining_time(simulate):
    def work(robot, speaker):
        speaker.play("chirp", 440, 2, volume=0.5)
        robot.sleep_for(0.05)
        sound = speaker.playing()
        with pytest.raises(gsv.Refused, match="song"):
            speaker.play("song", 440, 1)
        speaker.silence()
        robot.sleep_for(0.05)
        return sound, speaker.playing()

    sound, after = in_run(simulate, lambda robot: robot.create(gsv.Speaker, "speaker"), work)
    assert (sound.name, sound.frequency, sound.volume) == ("chirp", 440, 0.5)
    assert (sound.elapsed, sound.left) == pytest.approx((0.05, 1.95))
    assert after.name == ""


def test_microphone_hears_the_speaker_of_another_robot(simulate):
    heard = []

    class Beeping(gsv.Behaviour):
        def init(self, robot):
            self.speaker = robot.create(gsv.Speaker, "voice", parameters={"loudness": 90.0})

        def run(self, robot):
            self.speaker.beep(1000, 1)

    class Listening(gsv.Behaviour):
        def init(self, robot):
            self.ear = robot.create(gsv.Microphone, "ear", parameters={"ambient": 0.0})

        def run(self, robot):
            robot.sleep_for(0.1)
            heard.append(self.ear.listen())

    simulation = simulate("playground")
    simulation.add("pebble", y=-1, name="beeper", behaviour=Beeping)
    simulation.add("pebble", y=1, name="listener", behaviour=Listening)
    simulation.run_until(0.2)
    hearing = heard[0]
    assert (hearing.frequency, hearing.source) == (1000, "beeper/voice")
    assert hearing.level == pytest.approx(90 - 20 * math.log10(2), abs=0.01)  # the microphone is 2 m away


def test_gripper_closes_and_opens(simulate):
    def work(robot, gripper):
        before = gripper.read()
        gripper.grasp()
        robot.sleep_for(1.0)
        closed = gripper.read()
        gripper.open()
        robot.sleep_for(0.9)
        return before, closed, gripper.read()

    before, closed, after = in_run(
        simulate, lambda robot: robot.open("gripper", gsv.Gripper), work, model="porter")
    assert before.told_to_open and before.opening > 0 and before.held == ""
    assert (closed.opening, closed.told_to_open, closed.held) == (0, False, "")
    assert after.opening == before.opening


def test_porter_has_the_same_hash_as_in_cpp(simulator, simulate, examples, tmp_path):
    world = tmp_path / "can.sdf"
    world.write_text(CAN_AHEAD)
    goal = ["--goal-x", "0.5", "--goal-y", "1.2"]
    simulator.start("gsv-fetch", "--name", "fetch-cpp", *goal)
    simulator.start(str(examples / "porter.py"), "--name", "fetch-py", *goal)
    hashes = set()
    for behaviour in ("fetch-cpp", "fetch-py"):
        simulation = simulate(str(world), seed=1)
        simulation.add("porter", behaviour=behaviour)
        simulation.run_until(25)
        porter = simulation.state().robots["porter"]
        assert porter.agent == "finished"
        # The robot drove to the goal with the can, and then 0.3 m back.
        assert math.hypot(porter.place.x - 0.5, porter.place.y - 1.2) == pytest.approx(0.3, abs=0.08)
        hashes.add(simulation.state_hash())
    assert len(hashes) == 1


def test_wide_angle_camera_is_opened_as_a_camera(simulate, tmp_path):
    model = tmp_path / "eye.sdf"
    model.write_text("""<sdf version='1.9'><model name='eye'><link name='base'>
      <collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
      <sensor name='eye' type='wideanglecamera'><camera><horizontal_fov>2.5</horizontal_fov>
        <image><width>32</width><height>24</height></image></camera></sensor></link>
      <plugin filename='gz-sim-velocity-control-system' name='v'/></model></sdf>""")
    image = in_run(simulate, lambda robot: robot.open("eye", gsv.Camera),
                     lambda robot, camera: camera.take_image(), model=str(model))
    assert image.shape == (24, 32, 3)


def test_deprecated_names_refer_to_the_new_ones():
    assert gsv.SatelliteReceiver is gsv.GnssReceiver
    assert gsv.Gripper.Jaws is gsv.Gripper.State
    for kind, old, name in (
            (gsv.Camera, "take_picture", "take_image"), (gsv.Imu, "feel", "read"),
            (gsv.Odometer, "reckon", "read"), (gsv.LogicalCamera, "look", "read"),
            (gsv.Lamp, "shine", "set"), (gsv.Lamp, "look", "read"),
            (gsv.Gripper, "grip", "grasp"), (gsv.Gripper, "let_go", "open"),
            (gsv.Gripper, "feel", "read")):
        assert getattr(kind, old) == getattr(kind, name)
