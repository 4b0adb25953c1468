"""Returns elements of SDFormat as text."""

TEXTURE = "<pbr><metal>{map}<roughness>{roughness}</roughness><metalness>{metalness}</metalness></metal></pbr>"


def material(colour=(1, 1, 1), texture=None, roughness=0.8, metalness=0.0):
    album = f"<albedo_map>model://textures/{texture}.jpg</albedo_map>" if texture else ""
    words = " ".join(f"{c:.6g}" for c in colour)
    pbr = TEXTURE.format(map=album, roughness=roughness, metalness=metalness)
    return f"<material><diffuse>{words} 1</diffuse>{pbr}</material>"


def pose(*values):
    values = values + (0,) * (6 - len(values))
    return "<pose>" + " ".join(f"{v:.6g}" for v in values) + "</pose>" if any(values) else ""


def box(x, y, z):
    return f"<geometry><box><size>{x:.6g} {y:.6g} {z:.6g}</size></box></geometry>"


def cylinder(radius, length):
    return (f"<geometry><cylinder><radius>{radius:.6g}</radius><length>{length:.6g}</length>"
            "</cylinder></geometry>")


def mesh(name):
    return f"<geometry><mesh><uri>meshes/{name}.obj</uri></mesh></geometry>"


def visual(name, geometry, looks, at=()):
    return f'<visual name="{name}">{pose(*at)}{geometry}{looks}</visual>'


def collision(name, geometry, at=()):
    return f'<collision name="{name}">{pose(*at)}{geometry}</collision>'


def link(name, parts, at=(), inertial=""):
    lines = [f'<link name="{name}">{pose(*at)}', *(f"  {part}" for part in parts), "</link>"]
    if inertial:
        lines.insert(1, f"  {inertial}")
    return "\n".join(lines)


def inertial(mass, size, at=()):
    """Returns the <inertial> of a box with this mass in kg."""
    x, y, z = size
    ixx, iyy, izz = (mass * (a * a + b * b) / 12 for a, b in ((y, z), (x, z), (x, y)))
    return (f"<inertial>{pose(*at)}<mass>{mass:.6g}</mass><inertia><ixx>{ixx:.4g}</ixx>"
            f"<iyy>{iyy:.4g}</iyy><izz>{izz:.4g}</izz></inertia></inertial>")


def write_model(folder, comment, name, description, parts, static):
    folder.mkdir(parents=True, exist_ok=True)
    if static:
        parts = ["<static>true</static>", *parts]
    body = "\n".join(f"    {line}" for part in parts for line in part.splitlines())
    (folder / "model.sdf").write_text(
        f'<?xml version="1.0"?>\n<!-- {comment} Made by tools/make_assets. -->\n<sdf version="1.9">\n'
        f'  <model name="{folder.name}">\n{body}\n  </model>\n</sdf>\n', encoding="utf-8")
    (folder / "model.config").write_text(
        f'<?xml version="1.0"?>\n<model>\n  <name>{name}</name>\n  <version>1.0</version>\n'
        '  <sdf version="1.9">model.sdf</sdf>\n  <author>\n    <name>The GSV authors</name>\n  </author>\n'
        f"  <description>{description}</description>\n</model>\n", encoding="utf-8")


WORLD = """<?xml version="1.0"?>
<!-- {comment} Made by tools/make_assets. -->
<sdf version="1.9">
  <world name="{name}">
    <physics name="steps" type="ignored">
      <max_step_size>0.01</max_step_size>
      <real_time_factor>1</real_time_factor>
    </physics>
    <gravity>0 0 -9.8</gravity>
    <scene>
      <ambient>{ambient} 1</ambient>
      <background>0.62 0.76 0.9 1</background>
      <sky></sky>
      <shadows>true</shadows>
    </scene>
    <light name="sun" type="directional">
      <pose>0 0 20 0 0 0</pose>
      <diffuse>{sun} 1</diffuse>
      <specular>0.3 0.3 0.3 1</specular>
      <direction>0.42 0.3 -0.85</direction>
      <cast_shadows>true</cast_shadows>
    </light>
{body}
  </world>
</sdf>
"""


def include(model, name, *at, static=None):
    said = "" if static is None else f"<static>{'true' if static else 'false'}</static>"
    return f"<include><uri>model://{model}</uri><name>{name}</name>{pose(*at)}{said}</include>"


def write_world(path, comment, parts, ambient="0.5 0.5 0.52", sun="0.95 0.92 0.84"):
    body = "\n".join(f"    {line}" for part in parts for line in part.splitlines())
    path.write_text(WORLD.format(comment=comment, name=path.stem, body=body, ambient=ambient, sun=sun),
                    encoding="utf-8")
