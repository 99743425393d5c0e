#!/usr/bin/env python3
"""Writes an SDF world of many plants as COLLADA meshes with textures, to try the import with: scripts/make_large_world.py DIR [PLANTS [TRIANGLES]]

PLANTS (50) plants of TRIANGLES (12 000) triangles each, five fruits on every one; each has a mesh and a texture file of its own, as scans have.
  canopeer scene import DIR/large.world --model-path DIR/models --fruit pepper --leaf leaf --out out/large
"""
import math
import os
import random
import struct
import sys
import zlib

MODEL = """<?xml version="1.0"?>
<sdf version="1.6"><model name="{name}"><static>true</static><link name="link"><visual name="visual"><geometry><mesh>
<uri>model://{name}/meshes/{name}.dae</uri></mesh></geometry></visual></link></model></sdf>
"""
CONFIG = '<?xml version="1.0"?><model><name>{name}</name><sdf version="1.6">model.sdf</sdf></model>\n'


def write(path, data):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as out:
        out.write(data if isinstance(data, bytes) else data.encode())


def leaf_png(size=512):
    """A green disc on nothing: the alpha cuts the leaf out."""
    rows = bytearray()
    for v in range(size):
        rows.append(0)
        for u in range(size):
            inside = (u - size / 2) ** 2 + (v - size / 2) ** 2 < (size / 2) ** 2
            rows += bytes((60 + (u ^ v) % 24, 110, 30, 255 if inside else 0))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", size, size, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(bytes(rows))) + chunk(b"IEND", b"")


def ball(centre, radius, sides):
    """Corners and triangles of a ball of sides x sides/2 facets."""
    points, triangles, rings = [], [], sides // 2
    for i in range(rings + 1):
        polar = math.pi * i / rings
        for k in range(sides):
            turn = 2 * math.pi * k / sides
            points.append([centre[0] + radius * math.sin(polar) * math.cos(turn), centre[1] + radius * math.sin(polar) * math.sin(turn),
                           centre[2] - radius * math.cos(polar)])
    for i in range(rings):
        for k in range(sides):
            a, b = i * sides + k, i * sides + (k + 1) % sides
            if i > 0:
                triangles.append((a, b, b + sides))
            if i + 1 < rings:
                triangles.append((a, b + sides, a + sides))
    return points, triangles


def leaf(foot, yaw, length, cells):
    """A bent square of 2 x cells x cells triangles."""
    points, triangles = [], []
    for i in range(cells + 1):
        for k in range(cells + 1):
            along, across = length * i / cells, length * (k / cells - 0.5)
            points.append([foot[0] + along * math.cos(yaw) - across * math.sin(yaw), foot[1] + along * math.sin(yaw) + across * math.cos(yaw),
                           foot[2] + 0.05 * math.sin(3 * i / cells)])
    for i in range(cells):
        for k in range(cells):
            a = i * (cells + 1) + k
            triangles += [(a, a + 1, a + cells + 2), (a, a + cells + 2, a + cells + 1)]
    return points, triangles


def surfaces(triangles, rng):
    """Material -> (points, triangles) of one plant."""
    parts = {"leaf": ([], []), "pepper": ([], [])}

    def add(name, shape):
        points, faces = parts[name]
        offset = len(points)
        points += shape[0]
        faces += [tuple(i + offset for i in t) for t in shape[1]]

    for i in range(5):
        turn = rng.uniform(0, 6.28)
        add("pepper", ball((0.12 * math.cos(turn), 0.12 * math.sin(turn), 0.3 + 0.15 * i), 0.035, 24))
    left = triangles - len(parts["pepper"][1])
    leaves = 30
    cells = max(1, round(math.sqrt(left / leaves / 2)))
    for i in range(leaves):
        add("leaf", leaf((0, 0, 0.15 + 0.9 * i / leaves), rng.uniform(0, 6.28), 0.16, cells))
    return parts


def dae(parts):
    sources, faces, effects, materials, binds = "", "", "", "", ""
    positions, uvs, offset = [], [], 0
    for name, (points, triangles) in parts.items():
        diffuse = '<texture texture="samp" texcoord="UV"/>' if name == "leaf" else "<color>0.8 0.16 0.04 1</color>"
        sampler = ('<newparam sid="surf"><surface type="2D"><init_from>img</init_from></surface></newparam><newparam sid="samp"><sampler2D>'
                   "<source>surf</source></sampler2D></newparam>") if name == "leaf" else ""
        effects += (f'<effect id="{name}-fx"><profile_COMMON>{sampler}<technique sid="c"><lambert><diffuse>{diffuse}</diffuse></lambert>'
                    "</technique></profile_COMMON></effect>")
        materials += f'<material id="{name}" name="{name}"><instance_effect url="#{name}-fx"/></material>'
        binds += (f'<instance_material symbol="{name}" target="#{name}"><bind_vertex_input semantic="UV" input_semantic="TEXCOORD" '
                  'input_set="0"/></instance_material>')
        for p in points:
            positions += [f"{x:.6f}" for x in p]
            uvs += [f"{p[0] * 6:.5f}", f"{p[1] * 6:.5f}"]
        index = " ".join(str(i + offset) for t in triangles for i in t)
        faces += (f'<triangles count="{len(triangles)}" material="{name}"><input semantic="VERTEX" source="#v" offset="0"/>'
                  f'<input semantic="TEXCOORD" source="#uv" offset="0" set="0"/><p>{index}</p></triangles>')
        offset += len(points)
    for key, numbers, stride, names in (("pos", positions, 3, "XYZ"), ("uv", uvs, 2, "ST")):
        params = "".join(f'<param name="{n}" type="float"/>' for n in names)
        sources += (f'<source id="{key}"><float_array id="{key}-a" count="{len(numbers)}">{" ".join(numbers)}</float_array><technique_common>'
                    f'<accessor source="#{key}-a" count="{len(numbers) // stride}" stride="{stride}">{params}</accessor></technique_common></source>')
    return ('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit name="meter" meter="1"/>'
            '<up_axis>Z_UP</up_axis></asset><library_images><image id="img"><init_from>leaf.png</init_from></image></library_images>'
            f"<library_effects>{effects}</library_effects><library_materials>{materials}</library_materials>"
            f'<library_geometries><geometry id="geo" name="plant"><mesh>{sources}<vertices id="v"><input semantic="POSITION" source="#pos"/></vertices>'
            f'{faces}</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="plant" name="plant">'
            f'<instance_geometry url="#geo"><bind_material><technique_common>{binds}</technique_common></bind_material></instance_geometry></node>'
            '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>\n')


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder = sys.argv[1]
    plants = int(sys.argv[2]) if len(sys.argv) > 2 else 50
    triangles = int(sys.argv[3]) if len(sys.argv) > 3 else 12000
    rng, picture, models = random.Random(1), leaf_png(), ""
    for i in range(plants):
        name = f"plant_{i + 1}"
        base = os.path.join(folder, "models", name)
        write(f"{base}/model.config", CONFIG.format(name=name))
        write(f"{base}/model.sdf", MODEL.format(name=name))
        write(f"{base}/meshes/{name}.dae", dae(surfaces(triangles, rng)))
        write(f"{base}/materials/textures/leaf.png", picture)
        models += f"<include><uri>model://{name}</uri><pose>{0.75 if i % 2 else -0.75} {-0.5 * (i // 2)} 0 0 0 {rng.uniform(0, 6.28):.3f}</pose></include>\n"
    write(os.path.join(folder, "large.world"), f'<?xml version="1.0"?>\n<sdf version="1.6"><world name="large">\n{models}</world></sdf>\n')


main()
