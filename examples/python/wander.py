#!/usr/bin/python3
"""The behaviour behaviours/wander.cc in Python. It gives the same commands, so runs in lockstep are
bit-identical.

    examples/python/wander.py --broker REFERENCE [--name NAME] [--no-pictures]
"""
import argparse
import math

import gsv

RECONSIDER_AFTER, RECONSIDER_FOR = 200, 40  # control cycles


class Rule:
    """Decides how to drive: forward if there is space, else a turn to the side with more space."""

    def __init__(self):
        self.turn = 0  # +1 for a turn to the left, -1 to the right, 0 for driving forward
        self.forward = 0  # number of control cycles spent driving forward
        self.reconsidering = 0  # remaining control cycles of reconsider()

    def decide(self, radius, echoes):
        if self.reconsidering > 0:
            return self._reconsider(radius, echoes)
        ahead = gsv.nearest(echoes, 0.0, 0.9)
        left = gsv.nearest(echoes, 0.9, 0.9)
        right = gsv.nearest(echoes, -0.9, 0.9)
        # Starts to turn when an obstacle ahead is nearer than radius + 0.4 m. Turns until no
        # obstacle ahead is nearer than radius + 0.7 m.
        if ahead < radius + (0.7 if self.turn else 0.4):
            self.turn = self.turn or (1 if left >= right else -1)
            return 0.0, 0.9 * self.turn
        self.turn = 0
        # Drifts to the left and to the right in turn, because a straight path shows little of a
        # room. After a while it drives backwards and turns, because an object between the beams
        # may block it.
        self.forward = (self.forward + 1) % RECONSIDER_AFTER
        if self.forward == 0:
            self.reconsidering = RECONSIDER_FOR
        speed = min(max(0.5 * (ahead - radius), 0.1), 0.4)
        return speed, 0.1 if self.forward < RECONSIDER_AFTER // 2 else -0.1

    def _reconsider(self, radius, echoes):
        """Drives backwards if there is space behind, then turns."""
        self.reconsidering -= 1
        room_behind = gsv.nearest(echoes, math.pi, 0.9) > radius + 0.25
        if self.reconsidering > RECONSIDER_FOR // 2 and room_behind:
            return -0.2, 0.0
        return 0.0, 0.9


class Wander(gsv.Behaviour):
    """Wanders without collisions, in Python."""

    def __init__(self, options):
        self.takes_pictures = not options.no_pictures
        self.rule = Rule()

    def init(self, robot):
        self.sonars = gsv.SonarRing(robot, 8)
        self.camera = self._open_or_mount_camera(robot) if self.takes_pictures else None

    @staticmethod
    def _open_or_mount_camera(robot):
        for sensor in robot.sensors():
            if sensor.type == "camera":
                return robot.open(sensor.name)
        size = {"image.width": 320, "image.height": 240, "horizontal_fov": 1.047}
        try:
            return robot.create(gsv.Camera, "camera", gsv.Placement(x=0.05, z=0.25), size)
        except gsv.Error:
            return None  # a robot without a camera wanders without it

    def run(self, robot):
        next_picture = robot.now()
        while True:
            robot.drive(*self.rule.decide(robot.footprint_radius, self.sonars.read()))
            if self.camera and robot.now() >= next_picture:
                self.camera.take_image()
                next_picture += 1.0
                if not robot.sleep_for(0.02):
                    return
            if not robot.sleep_for(0.05):
                return


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=Wander.__doc__)
    parser.add_argument("--no-pictures", action="store_true", help="do not use the camera")
    gsv.serve("wander", Wander, parser)
