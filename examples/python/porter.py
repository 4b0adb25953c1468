#!/usr/bin/python3
"""The behaviour behaviours/fetch.cc in Python: carries a body in front of its gripper to a point.

    examples/python/porter.py --broker REFERENCE [--name NAME] [--goal-x X] [--goal-y Y]

Its LED shows the state: yellow while searching, green with a body, red without, blue at the end.
"""
import argparse
import math

import gsv

BETWEEN_FINGERS = 0.03  # a body nearer to the sonar is between the fingers, m
BACK_OFF, BACK_OFF_SPEED = 0.3, 0.15  # m, m/s
YELLOW, GREEN, RED, BLUE = (gsv.Colour(1, 0.7, 0), gsv.Colour(0, 1, 0), gsv.Colour(1, 0, 0),
                            gsv.Colour(0, 0, 1))


def clamp(value, least, most):
    return min(max(value, least), most)


class Porter(gsv.Behaviour):
    """Carries a body in front of its gripper to a point, in Python."""

    def __init__(self, options):
        self.goal, self.tolerance = (options.goal_x, options.goal_y), options.tolerance

    def init(self, robot):
        self.ahead = robot.open("ahead", gsv.Sonar)
        self.gripper = robot.open("gripper", gsv.Gripper)
        self.led = robot.open("led", gsv.Lamp)
        self.speaker = robot.open("speaker", gsv.Speaker)
        self.positioning = robot.create(gsv.PositioningSystem, "fetch_position")

    def run(self, robot):
        try:
            self.fetch(robot)
        except gsv.Ended:
            pass  # the run ended before the command

    def fetch(self, robot):
        self.led.set(YELLOW)
        if not self.approach(robot) or not self.take(robot):
            return
        if not self.gripper.read().held:
            self.say(RED, 220)
            return
        self.say(GREEN, 880)
        if not self.carry_to_goal(robot):
            return
        self.gripper.open()
        if not robot.sleep_for(0.7):
            return
        way = 0.0
        while way < BACK_OFF:
            robot.drive(-BACK_OFF_SPEED, 0)
            if not robot.sleep_for(0.05):
                return
            way += 0.05 * BACK_OFF_SPEED
        robot.drive(0, 0)
        self.say(BLUE, 1320)

    def approach(self, robot):
        while (distance := self.ahead.range()) > BETWEEN_FINGERS:
            robot.drive(clamp(0.8 * (distance - BETWEEN_FINGERS), 0.02, 0.3), 0)
            if not robot.sleep_for(0.05):
                return False
        robot.drive(0, 0)
        return robot.is_running

    def take(self, robot):
        """Closes the fingers, and waits until they hold a body or are completely closed."""
        self.gripper.grasp()
        while robot.sleep_for(0.05):
            state = self.gripper.read()
            if state.held or state.opening <= 0:
                return True
        return False

    def carry_to_goal(self, robot):
        while True:
            here = self.positioning.locate()
            dx, dy = self.goal[0] - here.x, self.goal[1] - here.y
            distance = abs(complex(dx, dy))  # equals hypot() of C; math.hypot() rounds differently
            if not robot.is_running:
                return False
            if distance < self.tolerance:
                break
            bearing = math.remainder(math.atan2(dy, dx) - here.yaw, 2 * math.pi)
            speed = clamp(distance, 0.05, 0.3) if abs(bearing) < 0.3 else 0
            robot.drive(speed, clamp(2 * bearing, -1.0, 1.0))
            if not robot.sleep_for(0.05):
                return False
        robot.drive(0, 0)
        return robot.sleep_for(0.5)

    def say(self, colour, frequency):
        self.led.set(colour)
        self.speaker.beep(frequency)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=Porter.__doc__)
    parser.add_argument("--goal-x", type=float, default=0.0, help="x of the goal in the world, m")
    parser.add_argument("--goal-y", type=float, default=0.0, help="y of the goal in the world, m")
    parser.add_argument("--tolerance", type=float, default=0.05, help="distance from the goal at which the robot stops, m")
    gsv.serve("porter", Porter, parser)
