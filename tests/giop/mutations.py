"""Mutates valid requests: their values before they are written, and their bytes afterwards.

The random.Random that each function receives determines the result.
"""

import math
import struct

from cdr import KINDS, NUMBERS, Reference
from giop import fragments, request

TEXTS = ["", " ", "\0", "x" * 5000, "../../../etc/passwd", "%s%n", "'", "((((((((", "ü" * 50, b"\xff\xfe\x80",
         "IDL:omg.org/CORBA/Object:1.0", "model://" + "a/" * 200, "true", "-1", "nan", "1e999"]
FRACTIONS = [0.0, -0.0, -1.0, math.nan, math.inf, -math.inf, 1e308, -1e308, 5e-324, 1e-9, 1e9, 0.5]
LENGTHS = [0, 1, 2, 3, 7, 255, 256, 65535, 65536, 1 << 20, 1 << 24, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFE, 0xFFFFFFFF]
CONTEXTS = [0, 1, 2, 5, 6, 7, 9, 0x41545400, 0xFFFFFFFF]  # transactions, code sets, bidirectional IIOP, …
WHOLE = {"short": 16, "ushort": 16, "long": 32, "ulong": 32, "longlong": 64, "ulonglong": 64, "octet": 8,
         "boolean": 8, "char": 8}


# Values


def number(chance, kind):
    if kind in ("float", "double"):
        value = chance.choice([*FRACTIONS, chance.gauss(0, 1000)])
        return max(-3e38, min(3e38, value)) if kind == "float" and math.isfinite(value) else value
    bits = WHOLE[kind]
    low = 0 if kind[0] in "uobc" else -(1 << (bits - 1))
    high = (1 << bits) - 1 + low
    return max(low, min(high, chance.choice([0, 1, -1, 2, 1000, low, high, high - 1, chance.randint(low, high)])))


def type_code(chance, depth=0):
    """Returns a random TypeCode. It is usually well-formed, but need not have a meaning."""
    simple = [name for name in KINDS if name in NUMBERS] + ["any", "TypeCode", "null", "void"]
    choice = chance.randrange(12) if depth < chance.choice([2, 4, 60]) else 0
    text = chance.choice(["", "a", "IDL:a:1.0"])
    if choice < 3:
        return chance.choice([*simple, "Principal", "longdouble", "wchar"])
    if choice == 3:
        return ("string", chance.choice(LENGTHS))
    if choice in (4, 5):
        return (chance.choice(["sequence", "array"]), type_code(chance, depth + 1), chance.choice([0, *LENGTHS]))
    if choice == 6:
        return ("alias", text, text, type_code(chance, depth + 1))
    if choice in (7, 8):
        members = [("m", type_code(chance, depth + 1)) for _ in range(chance.choice([0, 1, 2, 5]))]
        return (chance.choice(["struct", "except"]), text, text, members)
    if choice == 9:
        return ("enum", text, text, ["A"] * chance.choice([0, 1, 3, 300]))
    if choice == 10:
        return ("union", text, text, chance.choice(["long", "boolean", "char", "short"]),
                [(chance.choice([0, 1, 1, 100]), "m", type_code(chance, depth + 1))
                 for _ in range(chance.choice([0, 1, 2, 3]))])
    return ("indirection", chance.choice([-4, -8, 0, 4, -1, -40, -(1 << 31)]))


def any_value(chance, code, depth=0):
    """Returns a random value of the type that the TypeCode describes, if such a value exists."""
    kind = code if isinstance(code, str) else code[0]
    if kind in NUMBERS:
        return number(chance, kind)
    if kind == "string":
        return chance.choice(TEXTS)
    if kind in ("sequence", "array"):
        few = 0 if depth > 8 else chance.randrange(3)
        return [any_value(chance, code[1], depth + 1) for _ in range(few if kind == "sequence" else min(code[2], 4))]
    if kind == "alias":
        return any_value(chance, code[3], depth)
    if kind in ("struct", "except"):
        return [any_value(chance, member, depth + 1) for _, member in code[3]]
    if kind == "enum":
        return chance.choice(LENGTHS[:5])
    if kind == "union":
        label = chance.choice(code[4])[0] if code[4] else 0
        # If several members have the label, the first one is used, as when the value is written.
        member = next((each for each in code[4] if each[0] == label), (label, "", "void"))
        return (label, any_value(chance, member[2], depth + 1))
    if kind == "any":
        return an_any(chance, depth + 1)
    return "long" if kind == "TypeCode" else Reference() if kind == "objref" else None


def an_any(chance, depth=0):
    code = type_code(chance, depth)
    return (code, any_value(chance, code, depth))


def reference(chance, value):
    choice = chance.randrange(5)
    if choice == 0:
        return Reference()
    key = bytes(chance.randrange(256) for _ in range(chance.choice([1, 4, 14, 200])))
    return Reference(chance.choice([value.type_id, "", "IDL:gsv/sba/Sonar:1.0", "x" * 2000]),
                     chance.choice(["127.0.0.1", "", "0.0.0.0", "no.such.host.invalid", "127.0.0.1" * 30]),
                     chance.choice([0, 1, value.port, value.port, 65535]), chance.choice([key, value.key]))


def spoilt(chance, kind, value):
    """Returns the value with one of its parts replaced by an unusual value."""
    if isinstance(kind, str):
        if kind in NUMBERS:
            return number(chance, kind)
        return {"string": lambda: chance.choice(TEXTS), "any": lambda: an_any(chance),
                "TypeCode": lambda: type_code(chance)}[kind]()
    if kind[0] == "sequence":
        if kind[1] == "octet":
            return bytes(chance.choice([0, 1, 1000, 70000]))
        if not value or chance.random() < 0.2:
            return list(value) * chance.choice([0, 2, 100, 3000])
        place = chance.randrange(len(value))
        return [*value[:place], spoilt(chance, kind[1], value[place]), *value[place + 1:]]
    if kind[0] == "struct":
        name, member = chance.choice(kind[2])
        return {**value, name: spoilt(chance, member, value[name])}
    if kind[0] == "enum":
        return chance.choice([chance.randrange(len(kind[2])), len(kind[2]), *LENGTHS])
    if kind[0] == "objref":
        return reference(chance, value)
    return (chance.choice(kind[2][2]), value[1]) if value[1] is not None else value


# Bytes


def change_bytes(chance, message, _):
    for _ in range(chance.choice([1, 1, 2, 8])):
        place = chance.randrange(len(message))
        message[place] = chance.choice([chance.randrange(256), message[place] ^ (1 << chance.randrange(8)), 0, 255])


def change_length(chance, message, lengths):
    if not lengths:
        return change_bytes(chance, message, lengths)
    place = chance.choice(lengths)
    order = "<I" if message[6] & 1 else ">I"
    if place + 4 <= len(message):
        found, = struct.unpack_from(order, message, place)
        value = chance.choice([*LENGTHS, found + 1, found - 1, found * 2, len(message), len(message) - place - 4])
        struct.pack_into(order, message, place, value % (1 << 32))
    return None


def change_word(chance, message, _):
    place = 4 * chance.randrange(len(message) // 4)
    message[place:place + 4] = struct.pack("<I", chance.choice(LENGTHS))


def cut(chance, message, _):
    del message[chance.randrange(12, len(message) + 1):]


def lengthen(chance, message, _):
    message += bytes(chance.randrange(256) for _ in range(chance.choice([1, 4, 100, 3000])))


def move(chance, message, _):
    begin, end = sorted(chance.randrange(12, len(message) + 1) for _ in range(2))
    piece = message[begin:end]
    if chance.random() < 0.5:
        del message[begin:end]
    place = chance.randrange(12, len(message) + 1)
    message[place:place] = piece * chance.choice([1, 1, 3])


def change_header(chance, message, _):
    place = chance.choice([4, 5, 6, 7])
    message[place] = chance.choice([0, 1, 2, 3, 4, 5, 6, 7, 8, 255, message[place] ^ 1])


BYTES = [change_bytes, change_bytes, change_length, change_length, change_word, cut, lengthen, move, change_header]


def mutant(chance, world, target, operation):
    """Returns the bytes of one malformed request, in the pieces in which they are sent."""
    values = world.values(operation)
    parameters = [(kind, name) for direction, name, kind in operation.parameters if direction != "out"]
    if parameters and chance.random() < 0.5:
        for _ in range(chance.choice([1, 1, 3])):
            kind, name = chance.choice(parameters)
            values[name] = spoilt(chance, kind, values[name])
    key, called = target.key, operation.name
    if chance.random() < 0.08:
        key = chance.choice([b"", b"\0", key[:-1], key + b"x", key * 300, chance.choice(world.keys)])
    if chance.random() < 0.08:
        called = chance.choice(["", "_is_a", "_non_existent", "_interface", "x" * 3000, chance.choice(world.names)])
    contexts = [(chance.choice(CONTEXTS), bytes(chance.randrange(256) for _ in range(chance.choice([0, 4, 12, 300]))))
                for _ in range(chance.choice([0] * 6 + [1, 2, 50]))]
    written = request(key, called, lambda out: [out.value(kind, values[name]) for kind, name in parameters],
                      number=chance.choice([1, 1, 0, 0xFFFFFFFF]), little=chance.random() < 0.7,
                      minor=chance.choice([2, 2, 2, 1, 0]), contexts=contexts)
    message = written.bytes
    places = sorted({8 * chance.randrange(2, len(message) // 8 + 1) for _ in range(chance.choice([1, 2, 9]))})
    if chance.random() < 0.15 and message[5] == 2 and places[-1] < len(message):
        pieces = fragments(bytes(message), places, number=chance.choice([1, 1, 2]))
        return broken_fragments(chance, pieces)
    for _ in range(chance.choice([0, 1, 1, 1, 2, 4])):
        if len(message) > 12:
            chance.choice(BYTES)(chance, message, written.lengths)
    if len(message) >= 12 and chance.random() < 0.8:  # otherwise its length field is wrong
        struct.pack_into("<I" if message[6] & 1 else ">I", message, 8, len(message) - 12)
    return [bytes(message)]


def broken_fragments(chance, pieces):
    choice = chance.randrange(6)
    if choice == 1:
        del pieces[chance.randrange(len(pieces))]
    elif choice == 2:
        chance.shuffle(pieces)
    elif choice == 3:
        pieces *= 2
    elif choice == 4:
        place = chance.randrange(len(pieces))
        damaged = bytearray(pieces[place])
        change_bytes(chance, damaged, [])
        pieces[place] = bytes(damaged)
    elif choice == 5:
        pieces.append(pieces[-1])
    return pieces
