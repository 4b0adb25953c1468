"""Makes the meshes, textures, the building, the warehouse, the yard and the car of assets/:
python3 tools/make_assets

Its results are committed; run it again after changing it. Textures need ImageMagick's `convert`,
all else only Python. The same scripts give the same meshes; JPEGs may differ between versions of
ImageMagick, so `python3 tools/make_assets textures` makes them only when asked for.
"""

import sys
from pathlib import Path

import building
import car
import robots
import textures
import things
import warehouse
import yard

ASSETS = Path(__file__).resolve().parent.parent.parent / "assets"


def main(arguments):
    models = ASSETS / "models"
    if arguments == ["textures"]:
        textures.make(models / "textures")
        return 0
    if arguments:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    robots.make(models)
    things.make(models)
    building.make(models / "office_building")
    car.make(models)
    warehouse.make(ASSETS)
    yard.make(ASSETS)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
