"""Makes the meshes, textures, the building, the warehouse, the yard and the car of assets/:
python3 tools/make_assets

The results are committed: after a change of these scripts, run them again. Textures need ImageMagick's
`convert`; all other assets only need Python. The meshes are always the same. JPEG files may differ
between versions of ImageMagick, so only `python3 tools/make_assets textures` makes the textures.
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
