"""Writes and reads CDR for the types of signatures.py, without an ORB (CORBA 3.1 part 2, 7.3).

A TypeCode is the name of a simple type, or one of these tuples:
  ("string", BOUND), ("sequence", TC, BOUND), ("array", TC, LENGTH), ("alias", ID, NAME, TC),
  ("struct", ID, NAME, [(NAME, TC) …]), ("enum", ID, NAME, [NAME …]), ("objref", ID, NAME),
  ("union", ID, NAME, TC, [(LABEL, NAME, TC) …]), ("indirection", OFFSET)
An `any` is (TC, value).
"""

import struct
from dataclasses import dataclass, field

# The format for `struct`, and the size in bytes, which is also the alignment.
NUMBERS = {"short": ("h", 2), "long": ("i", 4), "ushort": ("H", 2), "ulong": ("I", 4), "float": ("f", 4),
           "double": ("d", 8), "longlong": ("q", 8), "ulonglong": ("Q", 8), "octet": ("B", 1), "boolean": ("B", 1),
           "char": ("B", 1)}
KINDS = ["null", "void", "short", "long", "ushort", "ulong", "float", "double", "boolean", "char", "octet", "any",
         "TypeCode", "Principal", "objref", "struct", "union", "enum", "string", "sequence", "array", "alias",
         "except", "longlong", "ulonglong", "longdouble", "wchar", "wstring", "fixed"]
INDIRECTION = 0xFFFFFFFF


@dataclass(frozen=True)
class Reference:
    """A reference to an object: its host, port and key. Without a key, it is nil."""
    type_id: str = ""
    host: str = ""
    port: int = 0
    key: bytes = b""


@dataclass
class Writer:
    little: bool = True
    bytes: bytearray = field(default_factory=bytearray)
    lengths: list = field(default_factory=list)  # positions of lengths and counts

    def align(self, size):
        self.bytes += bytes(-len(self.bytes) % size)

    def number(self, kind, value):
        code, size = NUMBERS[kind]
        self.align(size)
        self.bytes += struct.pack(("<" if self.little else ">") + code, value)

    def length(self, value):
        self.align(4)
        self.lengths.append(len(self.bytes))
        self.number("ulong", value)

    def octets(self, value):
        self.length(len(value))
        self.bytes += value

    def string(self, value):
        self.octets((value if isinstance(value, bytes) else value.encode()) + b"\0")

    def encapsulation(self, write):
        """Writes an encapsulation that `write` fills.

        `self.lengths` also gets the positions of the lengths inside the encapsulation.
        """
        inner = Writer(self.little, bytearray([self.little]))
        write(inner)
        self.length(len(inner.bytes))
        self.lengths += [len(self.bytes) + place for place in inner.lengths]
        self.bytes += inner.bytes

    def reference(self, value):
        self.string(value.type_id)
        self.length(1 if value.key else 0)
        if not value.key:
            return
        self.number("ulong", 0)  # TAG_INTERNET_IOP

        def profile(inner):
            inner.bytes += b"\x01\x02"
            inner.string(value.host)
            inner.number("ushort", value.port)
            inner.octets(value.key)
            inner.length(0)
        self.encapsulation(profile)

    def type_code(self, code):
        kind = code if isinstance(code, str) else code[0]
        if kind == "indirection":
            self.number("ulong", INDIRECTION)
            return self.number("long", code[1])
        self.number("ulong", KINDS.index(kind))
        if kind == "string":
            return self.length(code[1] if len(code) == 2 else 0)
        if isinstance(code, str):
            return None

        def parameters(inner):
            if kind in ("sequence", "array"):
                inner.type_code(code[1])
                return inner.length(code[2])
            inner.string(code[1])
            inner.string(code[2])
            if kind == "alias":
                return inner.type_code(code[3])
            if kind == "union":
                inner.type_code(code[3])
                inner.number("long", -1)
            if kind != "objref":
                members = code[-1]
                inner.length(len(members))
                for member in members:
                    if kind == "union":
                        inner.plain(code[3], member[0])
                    inner.string(member if kind == "enum" else member[-2])
                    if kind != "enum":
                        inner.type_code(member[-1])
            return None
        return self.encapsulation(parameters)

    def plain(self, code, value):
        """Writes a value of the type that a TypeCode describes."""
        kind = code if isinstance(code, str) else code[0]
        if kind in NUMBERS:
            self.number(kind, value)
        elif kind == "string":
            self.string(value)
        elif kind == "enum":
            self.number("ulong", value)
        elif kind == "sequence":
            self.length(len(value))
            for each in value:
                self.plain(code[1], each)
        elif kind == "array":
            for each in value:
                self.plain(code[1], each)
        elif kind == "alias":
            self.plain(code[3], value)
        elif kind == "struct":
            for (_, member), each in zip(code[3], value):
                self.plain(member, each)
        elif kind == "union":
            self.plain(code[3], value[0])
            self.plain(next((member[2] for member in code[4] if member[0] == value[0]), "void"), value[1])
        elif kind == "objref":
            self.reference(value)
        elif kind == "any":
            self.any(value)
        elif kind == "TypeCode":
            self.type_code(value)

    def any(self, value):
        self.type_code(value[0])
        self.plain(value[0], value[1])

    def value(self, kind, value):
        """Writes a value of a type of signatures.py. Structs are dictionaries; enumerators and union cases are names."""
        if isinstance(kind, str):
            self.plain(kind, value)
        elif kind[0] == "sequence":
            if kind[1] == "octet":
                return self.octets(value)
            self.length(len(value))
            for each in value:
                self.value(kind[1], each)
        elif kind[0] == "struct":
            for name, member in kind[2]:
                self.value(member, value[name])
        elif kind[0] == "enum":
            self.number("ulong", kind[2].index(value) if isinstance(value, str) else value)
        elif kind[0] == "objref":
            self.reference(value)
        else:  # a union: (case, value or None)
            self.value(kind[2], value[0])
            if value[0] in kind[3]:
                self.value(kind[3][value[0]][1], value[1])
        return None


class Reader:
    def __init__(self, data, little, place=0):
        self.data, self.little, self.place = data, little, place

    def align(self, size):
        self.place += -self.place % size

    def number(self, kind):
        code, size = NUMBERS[kind]
        self.align(size)
        value, = struct.unpack_from(("<" if self.little else ">") + code, self.data, self.place)
        self.place += size
        return value

    def octets(self):
        length = self.number("ulong")
        if length > len(self.data) - self.place:
            raise ValueError(f"{length} bytes do not lie in the message")
        self.place += length
        return bytes(self.data[self.place - length:self.place])

    def string(self):
        return self.octets()[:-1].decode(errors="replace")

    def encapsulation(self):
        data = self.octets()
        return Reader(data, data[:1] == b"\x01", 1)

    def reference(self):
        found = Reference()
        type_id = self.string()
        for _ in range(self.number("ulong")):
            tag = self.number("ulong")
            profile = self.encapsulation()
            if tag == 0 and not found.key:
                profile.place += 2
                found = Reference(type_id, profile.string(), profile.number("ushort"), profile.octets())
        return found

    def type_code(self):
        kind = self.number("ulong")
        if kind == INDIRECTION:
            return ("indirection", self.number("long"))
        name = KINDS[kind]
        if name in ("string", "wstring"):
            return (name, self.number("ulong"))
        if name in ("objref", "struct", "union", "enum", "sequence", "array", "alias", "except"):
            inner = self.encapsulation()
            if name in ("sequence", "array"):
                return (name, inner.type_code(), inner.number("ulong"))
            head = (name, inner.string(), inner.string())
            if name == "alias":
                return (*head, inner.type_code())
            if name == "struct":
                return (*head, [(inner.string(), inner.type_code()) for _ in range(inner.number("ulong"))])
            if name == "enum":
                return (*head, [inner.string() for _ in range(inner.number("ulong"))])
            if name == "union":
                discriminator = inner.type_code()
                inner.number("long")
                return (*head, discriminator, [(inner.plain(discriminator), inner.string(), inner.type_code())
                                               for _ in range(inner.number("ulong"))])
            return head
        return name

    def plain(self, code):
        kind = code if isinstance(code, str) else code[0]
        if kind in NUMBERS:
            return self.number(kind)
        if kind == "sequence":
            return [self.plain(code[1]) for _ in range(self.number("ulong"))]
        if kind == "alias":
            return self.plain(code[3])
        if kind == "struct":
            return {name: self.plain(member) for name, member in code[3]}
        if kind == "enum":
            return self.number("ulong")
        if kind == "union":
            case = self.plain(code[3])
            return (case, next((self.plain(member[2]) for member in code[4] if member[0] == case), None))
        readers = {"string": self.string, "objref": self.reference, "any": self.any, "TypeCode": self.type_code}
        return readers[kind]() if kind in readers else None

    def any(self):
        code = self.type_code()
        return (code, self.plain(code))

    def value(self, kind):
        if isinstance(kind, str):
            return self.plain(kind)
        if kind[0] == "sequence":
            if kind[1] == "octet":
                return self.octets()
            return [self.value(kind[1]) for _ in range(self.number("ulong"))]
        if kind[0] == "struct":
            return {name: self.value(member) for name, member in kind[2]}
        if kind[0] == "enum":
            return kind[2][self.number("ulong")]
        if kind[0] == "objref":
            return self.reference()
        case = self.value(kind[2])
        return (case, self.value(kind[3][case][1]) if case in kind[3] else None)
