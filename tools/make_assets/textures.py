"""Makes small seamless textures, computed pixel by pixel and written as JPEG by ImageMagick."""

import math
import random
import subprocess


class Noise:
    """Smooth noise in [0, 1] that repeats after `cells` cells in each direction."""

    def __init__(self, seed, cells_u, cells_v):
        source = random.Random(seed)
        self.cells = cells_u, cells_v
        self.grid = [[source.random() for _ in range(cells_u)] for _ in range(cells_v)]

    def at(self, u, v):
        """u and v in [0, 1)."""
        x, y = u * self.cells[0], v * self.cells[1]
        i, j = int(x), int(y)
        fx, fy = smooth(x - i), smooth(y - j)
        i0, i1 = i % self.cells[0], (i + 1) % self.cells[0]
        row0, row1 = self.grid[j % self.cells[1]], self.grid[(j + 1) % self.cells[1]]
        low = row0[i0] + (row0[i1] - row0[i0]) * fx
        high = row1[i0] + (row1[i1] - row1[i0]) * fx
        return low + (high - low) * fy


def smooth(t):
    return t * t * (3 - 2 * t)


def shade(colour, factor):
    return tuple(c * factor for c in colour)


def mixed(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def edge(distance, width):
    """Returns 0 on a line, and 1 at distances of `width` and more."""
    return min(abs(distance) / width, 1.0)


def planks(light, dark, rows, seed):
    """Boards along u, in `rows` rows above each other, each with its own grain and joint."""
    source = random.Random(seed)
    offsets = [source.random() for _ in range(rows)]
    tones = [[source.random() for _ in range(2)] for _ in range(rows)]
    grain, fine = Noise(seed, 4, rows * 12), Noise(seed + 1, 24, rows * 40)

    def colour(u, v):
        row = int(v * rows)
        along = (u + offsets[row]) % 1.0
        board = int(along * 2)
        t = 0.55 * grain.at((u + offsets[row]) % 1, v) + 0.25 * fine.at(u, v) + 0.2 * tones[row][board]
        across = v * rows - row
        gap = min(edge(min(across, 1 - across), 0.03), edge((along * 2) % 1, 0.006))
        return shade(mixed(light, dark, t), 0.55 + 0.45 * gap)

    return colour


def speckled(base, strength, seed, coarse=8, cells=128):
    large, small = Noise(seed, coarse, coarse), Noise(seed + 1, cells, cells)

    def colour(u, v):
        return shade(base, 1 + strength * (0.5 * large.at(u, v) + 0.5 * small.at(u, v) - 0.5))

    return colour


def tiles(base, joint, count, seed):
    source = random.Random(seed)
    tones = [[0.94 + 0.12 * source.random() for _ in range(count)] for _ in range(count)]
    clouds = Noise(seed, 16, 16)

    def colour(u, v):
        i, j = int(u * count), int(v * count)
        a, b = u * count - i, v * count - j
        t = edge(min(a, 1 - a, b, 1 - b), 0.025)
        return mixed(joint, shade(base, tones[j][i] * (0.95 + 0.1 * clouds.at(u, v))), t)

    return colour


def bricks(base, joint, across, rows, seed):
    source = random.Random(seed)
    tones = [[0.8 + 0.4 * source.random() for _ in range(across)] for _ in range(rows)]
    rough = Noise(seed, 64, 64)

    def colour(u, v):
        row = int(v * rows)
        x = (u + (0.5 / across if row % 2 else 0)) % 1.0 * across
        column = int(x)
        a, b = x - column, v * rows - row
        t = min(edge(min(a, 1 - a), 0.04), edge(min(b, 1 - b), 0.09))
        return mixed(joint, shade(base, tones[row][column] * (0.85 + 0.3 * rough.at(u, v))), smooth(t))

    return colour


def concrete(base, seed):
    """Concrete slabs with stains and fine cracks."""
    stains, grain = Noise(seed, 6, 6), Noise(seed + 1, 160, 160)

    def colour(u, v):
        joint = min(edge(min(u, 1 - u), 0.004), edge(min(v, 1 - v), 0.004))
        t = 0.9 + 0.12 * stains.at(u, v) + 0.1 * (grain.at(u, v) - 0.5)
        return shade(base, t * (0.75 + 0.25 * joint))

    return colour


def cardboard(base, tape, seed):
    """A box's side, with tape across its middle."""
    grain, waves = Noise(seed, 4, 96), Noise(seed + 1, 12, 12)

    def colour(u, v):
        if abs(v - 0.5) < 0.05:
            return shade(tape, 0.95 + 0.1 * waves.at(u, v))
        rim = min(edge(min(u, 1 - u), 0.02), edge(min(v, 1 - v), 0.02))
        return shade(base, (0.9 + 0.12 * grain.at(u, v) + 0.06 * waves.at(u, v)) * (0.8 + 0.2 * rim))

    return colour


def grass(seed):
    patches, blades, fine = Noise(seed, 5, 5), Noise(seed + 1, 48, 96), Noise(seed + 2, 128, 128)

    def colour(u, v):
        t = 0.45 * patches.at(u, v) + 0.35 * blades.at(u, v) + 0.2 * fine.at(u, v)
        return mixed((62, 88, 36), (140, 158, 84), t)

    return colour


def gravel(seed):
    stones, fine = Noise(seed, 72, 72), Noise(seed + 1, 128, 128)
    tint = Noise(seed + 2, 24, 24)

    def colour(u, v):
        t = 0.6 * stones.at(u, v) + 0.4 * fine.at(u, v)
        return mixed((112, 104, 94), mixed((196, 190, 178), (178, 164, 146), tint.at(u, v)), t)

    return colour


def book_spines(seed):
    """A shelf full of upright books."""
    source = random.Random(seed)
    cloths = [(122, 38, 36), (38, 66, 104), (44, 92, 66), (176, 140, 62), (84, 60, 96),
              (200, 190, 168), (58, 58, 62), (160, 84, 44)]
    books, u = [], 0.0
    while u < 1:
        width = source.uniform(0.025, 0.06)
        books.append((u, min(u + width, 1.0), source.uniform(0.72, 0.97), source.choice(cloths),
                      source.uniform(0.15, 0.4), source.choice([True, False])))
        u += width

    def colour(u, v):
        left, right, top, cloth, band, gilt = next(b for b in books if b[0] <= u < b[1] or b[1] == 1)
        height = 1 - v
        if height > top:
            return (26, 22, 20)
        across = (u - left) / max(right - left, 1e-6)
        rounded = 0.6 + 0.4 * math.sin(math.pi * min(max(across, 0.02), 0.98))
        if gilt and (abs(height - band) < 0.015 or abs(height - top + band / 2) < 0.015):
            return shade((214, 180, 96), rounded)
        return shade(cloth, rounded)

    return colour


def painting(seed):
    """Hills under an evening sky."""
    ridges = [Noise(seed + k, 3 + 2 * k, 1) for k in range(4)]
    hills = [(142, 120, 128), (104, 92, 112), (66, 74, 88), (36, 52, 56)]

    def colour(u, v):
        pixel = mixed((64, 96, 150), (250, 196, 132), min(1.0, v * 1.5))
        if math.hypot((u - 0.68) * 1.5, v - 0.42) < 0.085:
            pixel = (255, 236, 190)
        for k, hill in enumerate(hills):
            if v > 0.44 + 0.13 * k + 0.16 * (ridges[k].at(u * 0.999, 0) - 0.5):
                pixel = hill
        return pixel

    return colour


TEXTURES = {  # name: (width, height, colour of a point)
    "oak": (512, 512, planks((196, 150, 98), (142, 96, 56), 8, 1)),
    "beech": (256, 128, planks((222, 184, 138), (196, 150, 102), 1, 2)),
    "carpet": (256, 256, speckled((96, 106, 122), 0.3, 3)),
    "fabric": (128, 128, speckled((178, 92, 62), 0.45, 4, cells=64)),
    "plaster": (256, 256, speckled((236, 230, 218), 0.07, 5, cells=96)),
    "tiles": (256, 256, tiles((198, 196, 190), (128, 126, 122), 4, 6)),
    "brick": (512, 256, bricks((158, 80, 62), (186, 178, 168), 8, 10, 7)),
    "books": (512, 128, book_spines(9)),
    "concrete": (512, 512, concrete((164, 163, 158), 12)),
    "cardboard": (128, 128, cardboard((190, 148, 100), (206, 178, 130), 15)),
    "grass": (256, 256, grass(18)),
    "gravel": (256, 256, gravel(21)),
    "painting": (256, 192, painting(10)),
}


def make(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, (width, height, colour) in TEXTURES.items():
        pixels = bytearray()
        for j in range(height):
            for i in range(width):
                pixel = colour((i + 0.5) / width, (j + 0.5) / height)
                pixels += bytes(max(0, min(255, round(c))) for c in pixel)
        subprocess.run(
            ["convert", "ppm:-", "-strip", "-sampling-factor", "4:2:0", "-quality", "80",
             str(folder / f"{name}.jpg")],
            input=b"P6 %d %d 255\n" % (width, height) + pixels,
            check=True,
        )
