"""A behaviour that is implemented without an ORB. It only stores the hardware reference that it
receives.
"""

import queue
import socket
import threading

from cdr import Reader, Reference, Writer
from giop import LOCATE, LOCATE_REPLY, REPLY, REQUEST, Connection, finished, skip_contexts

KEY = b"behaviour"
TYPE = "IDL:gsv/sba/AgentBehaviour:1.0"


class RobotSide:
    def __init__(self):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.hardware = queue.Queue()
        self.reference = Reference(TYPE, "127.0.0.1", self.listener.getsockname()[1], KEY)
        threading.Thread(target=self.accept, daemon=True).start()

    def hardware_of(self, robot):
        """Returns the hardware reference of a robot. Waits until it is received."""
        while True:
            name, hardware = self.hardware.get(timeout=20)
            if name == robot:
                return hardware

    def accept(self):
        while True:
            accepted, _ = self.listener.accept()
            threading.Thread(target=self.serve, args=(accepted,), daemon=True).start()

    def serve(self, accepted):
        connection = Connection.__new__(Connection)
        connection.socket = accepted
        try:
            while True:
                answer = self.answer(connection.message())
                if answer:
                    accepted.sendall(answer)
        except (OSError, EOFError, ValueError):
            accepted.close()

    def answer(self, message):
        little = bool(message[6] & 1)
        reader = Reader(message, little, 12)
        out = Writer(little, bytearray(12))
        if message[7] == LOCATE:
            out.number("ulong", reader.number("ulong"))
            out.number("ulong", 1)  # here
            return bytes(finished(out, LOCATE_REPLY).bytes)
        if message[7] != REQUEST:
            return None
        out.number("ulong", reader.number("ulong"))
        reader.place += 4
        reader.number("ushort")
        reader.octets()
        operation = reader.string()
        skip_contexts(reader)
        out.number("ulong", 0)
        out.number("ulong", 0)
        if operation == "init":
            reader.align(8)
            self.hardware.put((reader.string(), reader.reference()))
        if operation.startswith("_"):
            out.align(8)
            out.number("boolean", operation == "_is_a")
        return bytes(finished(out, REPLY).bytes)
