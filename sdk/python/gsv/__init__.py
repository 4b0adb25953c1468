"""GSV in Python: behaviours that drive robots, and applications that run simulations.

    import gsv

    class Circle(gsv.Behaviour):
        \"\"\"Drives in a circle.\"\"\"
        def run(self, robot):
            while robot.sleep_for(0.05):
                robot.drive(0.3, 0.5)

    if __name__ == "__main__":
        gsv.serve("circle", Circle)

Frames are those of REP-103 (x forward, y left, z up), units metres, radians and seconds.
"""

from gsv._native import *  # the robot, its sensors and their readings
from gsv._native import __version__
from gsv.applications import Application, Simulation, connect
from gsv.behaviours import Behaviour, Controller, Offer, serve
from gsv.errors import (
    BadModel, BehaviourFailed, Corrupt, Ended, Error, NotFound, NotRunning, Refused, TimedOut,
    Unavailable)
from gsv.notebook import View, view

del end_with_parent  # internal: gsv.behaviours and the fixtures import it from gsv._native

__all__ = [name for name in dir() if not name.startswith("_")]
