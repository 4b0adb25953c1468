"""GIOP messages, and calls over TCP, without an ORB (CORBA 3.1 part 2, 9.4)."""

import socket
import struct

from cdr import Reader, Reference, Writer

REQUEST, REPLY, CANCEL, LOCATE, LOCATE_REPLY, CLOSE, ERROR, FRAGMENT = range(8)
TIMEOUT_S = 60  # time limit of a valid call; a program that takes longer counts as hung
STATUS = ["result", "user exception", "system exception", "forward"]


def finished(writer, kind, minor=2, more=False):
    """Writes the header into the twelve free bytes at the start of a message."""
    flags = (1 if writer.little else 0) | (2 if more else 0)
    writer.bytes[:12] = b"GIOP\x01" + bytes([minor, flags, kind]) + struct.pack(
        "<I" if writer.little else ">I", len(writer.bytes) - 12)
    return writer


def request(key, operation, write, number=1, little=True, minor=2, contexts=()):
    """Returns a request. `write` writes the arguments to a Writer. Contexts are (id, bytes)."""
    out = Writer(little, bytearray(12))

    def write_contexts():
        out.length(len(contexts))
        for tag, data in contexts:
            out.number("ulong", tag)
            out.octets(data)
    if minor < 2:
        write_contexts()
    out.number("ulong", number)
    out.bytes += b"\x03" if minor == 2 else b"\x01"
    if minor > 0:
        out.bytes += bytes(3)
    if minor == 2:
        out.number("ushort", 0)  # a key
    out.octets(key)
    out.string(operation)
    if minor == 2:
        write_contexts()
    else:
        out.octets(b"")  # no principal
    begin = len(out.bytes)
    if minor == 2:
        out.align(8)
    body = len(out.bytes)
    write(out)
    if len(out.bytes) == body:
        del out.bytes[begin:]
    return finished(out, REQUEST, minor)


def fragments(message, places, number=1):
    """Splits a message of GIOP 1.2 into fragments that begin at these multiples of eight."""
    little = bool(message[6] & 1)
    ends = [*places, len(message)]
    first = Writer(little, bytearray(message[:ends[0]]))
    pieces = [bytes(finished(first, message[7], more=len(ends) > 1).bytes)]
    for begin, end in zip(ends, ends[1:]):
        piece = Writer(little, bytearray(12))
        piece.number("ulong", number)
        piece.bytes += message[begin:end]
        pieces.append(bytes(finished(piece, FRAGMENT, more=end != len(message)).bytes))
    return pieces


class Refused(Exception):
    """The response was an exception, or there was no response."""


class Connection:
    def __init__(self, host, port, timeout):
        self.socket = socket.create_connection((host, port), timeout=timeout)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def receive(self, count):
        data = b""
        while len(data) < count:
            piece = self.socket.recv(count - len(data))
            if not piece:
                raise EOFError("the connection ended")
            data += piece
        return data

    def message(self):
        """Returns the next complete message, and joins fragments."""
        whole = b""
        while True:
            header = self.receive(12)
            if header[:4] != b"GIOP":
                raise ValueError(f"no GIOP: {header!r}")
            size, = struct.unpack("<I" if header[6] & 1 else ">I", header[8:])
            body = self.receive(size)
            whole += body[4:] if whole else header + body
            if not header[6] & 2:
                return whole


def read_reply(message):
    """Returns the kind of a reply, and a Reader for the rest."""
    if message[7] != REPLY:
        return ("MessageError" if message[7] == ERROR else f"type {message[7]}", None)
    reader = Reader(message, bool(message[6] & 1), 12)
    if message[5] < 2:
        skip_contexts(reader)
    reader.number("ulong")
    status = reader.number("ulong")
    if message[5] == 2:
        skip_contexts(reader)
        if reader.place < len(message):
            reader.align(8)
    return (STATUS[status] if status < len(STATUS) else f"status {status}", reader)


def skip_contexts(reader):
    for _ in range(reader.number("ulong")):
        reader.number("ulong")
        reader.octets()


def call(target, operation, values, timeout=TIMEOUT_S):
    """Calls an operation of contracts.py. Returns a dictionary of its results; the return value has the key ""."""
    arguments = [(kind, name) for direction, name, kind in operation.parameters if direction != "out"]

    def write(out):
        for kind, name in arguments:
            out.value(kind, values[name])
    with Connection(target.host, target.port, timeout) as connection:
        connection.socket.sendall(request(target.key, operation.name, write).bytes)
        status, reader = read_reply(connection.message())
    if status != "result":
        raise Refused(f"{operation}: {status} {reader.string() if reader else ''} {reason(status, reader)}")
    found = {}
    if operation.result != "void":
        found[""] = reader.value(operation.result)
    for direction, name, kind in operation.parameters:
        if direction != "in":
            found[name] = reader.value(kind)
    return found


def reason(status, reader):
    try:
        return reader.string() if status == "user exception" else hex(reader.number("ulong"))
    except (ValueError, struct.error):
        return ""


def corbaloc(text):
    """corbaloc::1.2@HOST:PORT/KEY"""
    host, _, rest = text.partition("@")[2].partition(":")
    port, _, key = rest.partition("/")
    return Reference("", host, int(port), key.encode())
