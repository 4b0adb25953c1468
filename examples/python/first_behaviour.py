#!/usr/bin/python3
"""A first behaviour: drives forward, and turns in front of walls.

    gsv broker --port 2809 &
    examples/python/first_behaviour.py --broker corbaloc::1.2@127.0.0.1:2809/TradingService &
    gsv run --broker corbaloc::1.2@127.0.0.1:2809/TradingService --robot pebble --behaviour first
"""
import gsv


class First(gsv.Behaviour):
    """Drives forward and turns in front of walls."""

    def init(self, robot):
        self.sonars = gsv.SonarRing(robot, 8)

    def run(self, robot):
        while True:
            ahead = gsv.nearest(self.sonars.read(), 0.0, 0.9)
            blocked = ahead < robot.footprint_radius + 0.4
            robot.drive(0.0 if blocked else 0.3, 0.8 if blocked else 0.0)
            if not robot.sleep_for(0.05):
                return


if __name__ == "__main__":
    gsv.serve("first", First)
