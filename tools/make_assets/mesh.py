"""Triangle meshes built from simple parts and written as Wavefront OBJ.

Lengths are in metres, with z up. Texture coordinates are in metres, with one repetition per metre,
unless a comment says otherwise; write() scales them.
"""

import math


class Mesh:
    def __init__(self):
        self.vertices = []  # (position, normal, texture coordinate)
        self.faces = []  # indices of vertices, counter-clockwise seen from outside

    def add_face(self, corners, normals, coordinates):
        first = len(self.vertices)
        self.vertices += zip(corners, normals, coordinates)
        self.faces.append(tuple(range(first, first + len(corners))))

    def add_quad(self, corners, coordinates=((0, 0), (1, 0), (1, 1), (0, 1))):
        """Adds a face with four corners, counter-clockwise as seen from the visible side."""
        normal = unit(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])))
        self.add_face(corners, [normal] * 4, coordinates)

    def add_box(self, low, high):
        """Adds a box between two corners. World coordinates determine the texture, so that adjacent boxes match."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        for x, ya, yb in ((x1, y0, y1), (x0, y1, y0)):
            self._add_side([(x, ya, z0), (x, yb, z0), (x, yb, z1), (x, ya, z1)], 1, 2)
        for y, xa, xb in ((y0, x0, x1), (y1, x1, x0)):
            self._add_side([(xa, y, z0), (xb, y, z0), (xb, y, z1), (xa, y, z1)], 0, 2)
        self._add_side([(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)], 0, 1)
        self._add_side([(x0, y1, z0), (x1, y1, z0), (x1, y0, z0), (x0, y0, z0)], 0, 1)

    def _add_side(self, corners, u_axis, v_axis):
        self.add_quad(corners, [(corner[u_axis], corner[v_axis]) for corner in corners])

    def add_lathe(self, profile, segments=32, begin=0.0, end=2 * math.pi):
        """Turns a profile of (radius, z), from bottom to top, about z between two angles.

        Normals are constant along each edge of the profile, and turn smoothly about z.
        """
        for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
            slope = unit((z1 - z0, 0, r0 - r1))
            for i in range(segments):
                a, b = (begin + (end - begin) * k / segments for k in (i, i + 1))
                corners = [polar(r0, a, z0), polar(r0, b, z0), polar(r1, b, z1), polar(r1, a, z1)]
                normals = [turned(slope, angle) for angle in (a, b, b, a)]
                keep = [0, 1, 2, 3]
                if r0 == 0:
                    keep = [0, 2, 3]
                elif r1 == 0:
                    keep = [0, 1, 2]
                self.add_face(
                    [corners[k] for k in keep],
                    [normals[k] for k in keep],
                    [(a * max(r0, r1), z0), (b * max(r0, r1), z0), (b * max(r0, r1), z1),
                     (a * max(r0, r1), z1)][: len(keep)],
                )

    def add(self, other, transform):
        """Adds another mesh. `transform(point, is_normal)` converts each point and normal."""
        first = len(self.vertices)
        self.vertices += [(transform(p, False), transform(n, True), t) for p, n, t in other.vertices]
        self.faces += [tuple(first + i for i in face) for face in other.faces]

    def write(self, path, texture_scale=1.0):
        path.parent.mkdir(parents=True, exist_ok=True)
        lists = {"v": {}, "vt": {}, "vn": {}}

        def index(kind, values, digits):
            text = " ".join(number(value, digits) for value in values)
            return lists[kind].setdefault(text, len(lists[kind]) + 1)

        faces = []
        for face in self.faces:
            words = []
            for i in face:
                position, normal, (u, v) = self.vertices[i]
                scaled = (u * texture_scale, v * texture_scale)
                words.append(
                    f"{index('v', position, 4)}/{index('vt', scaled, 3)}/{index('vn', normal, 3)}"
                )
            faces.append("f " + " ".join(words))
        with open(path, "w", encoding="ascii") as out:
            out.write("# Made by tools/make_assets\n")
            for kind, texts in lists.items():
                out.writelines(f"{kind} {text}\n" for text in texts)
            out.write("\n".join(faces) + "\n")


def number(value, digits):
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def polar(radius, angle, z):
    return (radius * math.cos(angle), radius * math.sin(angle), z)


def turned(vector, angle):
    x, y, z = vector
    c, s = math.cos(angle), math.sin(angle)
    return (c * x - s * y, s * x + c * y, z)


def minus(a, b):
    return tuple(p - q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def moved(x, y, z, yaw=0.0):
    """Returns a transform for Mesh.add: a rotation about z, then a translation."""

    def transform(point, is_normal):
        px, py, pz = turned(point, yaw)
        return (px, py, pz) if is_normal else (px + x, py + y, pz + z)

    return transform


def facing(radius, angle, z):
    """Returns a transform for Mesh.add that turns +z to the outward direction at an angle about z."""

    def transform(point, is_normal):
        px, py, pz = turned((point[2], point[0], point[1]), angle)
        if is_normal:
            return (px, py, pz)
        ox, oy, oz = polar(radius, angle, z)
        return (px + ox, py + oy, pz + oz)

    return transform
