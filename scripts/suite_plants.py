"""Plants of meshes with materials and a leaf texture, as people bring them: what scripts/make_suite.py imports. Each kind is
drawn from a seed, written as OBJ models of Gazebo's layout, and planted in an SDF world. z up, metres."""
import math
import random
import shutil

MATERIALS = {"stem": (0.40, 0.46, 0.16), "fruit_red": (0.80, 0.14, 0.04), "fruit_orange": (0.86, 0.38, 0.05),
             "fruit_green": (0.45, 0.54, 0.17), "calyx": (0.30, 0.45, 0.14)}

# Heights in m; nodes are this far apart and bear so many leaves; a node between `fruit_from` and the top bears fruit with
# this chance, in trusses of so many of this diameter and length.
KINDS = {
    "pepper": dict(height=(1.0, 1.3), node=0.075, leaves=2, leaf=(0.13, 0.18), fruit_from=0.30, chance=0.50, truss=(1, 1),
                   diameter=(0.062, 0.080), length=(0.070, 0.090)),
    "truss": dict(height=(1.3, 1.6), node=0.085, leaves=2, leaf=(0.15, 0.22), fruit_from=0.35, chance=0.24, truss=(4, 6),
                  diameter=(0.046, 0.056), length=(0.044, 0.054)),
    "bush": dict(height=(0.75, 0.95), node=0.050, leaves=3, leaf=(0.12, 0.16), fruit_from=0.20, chance=0.55, truss=(1, 2),
                 diameter=(0.058, 0.074), length=(0.064, 0.084)),
    "string": dict(height=(2.0, 2.3), node=0.075, leaves=2, leaf=(0.14, 0.20), fruit_from=0.40, chance=0.45, truss=(1, 1),
                   diameter=(0.060, 0.078), length=(0.070, 0.095)),
}


def add(a, b, k=1.0):
    return tuple(x + k * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def heading(azimuth, pitch):
    return (math.cos(pitch) * math.cos(azimuth), math.cos(pitch) * math.sin(azimuth), math.sin(pitch))


class Mesh:
    """A Wavefront OBJ file: one object a piece, so that each fruit is a body of its own."""

    def __init__(self):
        self.lines, self.points, self.uvs, self.objects = [], 0, 0, 0

    def piece(self, material, points, faces, uvs=()):
        self.objects += 1
        self.lines += [f"o {material}_{self.objects}", f"usemtl {material}"]
        self.lines += ["v %.5f %.5f %.5f" % p for p in points] + ["vt %.4f %.4f" % uv for uv in uvs]
        for face in faces:
            at = [str(self.points + i + 1) + (f"/{self.uvs + i + 1}" if uvs else "") for i in face]
            self.lines.append("f " + " ".join(at))
        self.points += len(points)
        self.uvs += len(uvs)

    def tube(self, material, axis, radii, sides=7):
        points, faces = [], []
        across = unit(cross(add(axis[1], axis[0], -1), (0.31, 0.17, 0.93)))
        for i, (p, radius) in enumerate(zip(axis, radii)):
            along = unit(add(axis[min(i + 1, len(axis) - 1)], axis[max(i - 1, 0)], -1))
            across = unit(add(across, along, -sum(x * y for x, y in zip(across, along))))
            other = cross(along, across)
            for k in range(sides):
                angle = 2 * math.pi * k / sides
                points.append(add(add(p, across, radius * math.cos(angle)), other, radius * math.sin(angle)))
        for i in range(len(axis) - 1):
            for k in range(sides):
                a, b = i * sides + k, i * sides + (k + 1) % sides
                faces += [(a, b, b + sides), (a, b + sides, a + sides)]
        last = (len(axis) - 1) * sides
        faces += [(0, k + 1, k) for k in range(1, sides - 1)] + [(last, last + k, last + k + 1) for k in range(1, sides - 1)]
        self.piece(material, points, faces)

    def leaf(self, base, azimuth, length, droop, roll):
        """A sheet of 2 × 6 pieces that bends down; the texture's alpha cuts its outline."""
        side = (-math.sin(azimuth), math.cos(azimuth), 0.0)
        points, uvs, p = [], [], base
        for i in range(7):
            pitch = droop[0] + (droop[1] - droop[0]) * i / 6
            up = cross(heading(azimuth, pitch), side)
            for k in (-1, 0, 1):
                lift = 0.18 * abs(k) + roll * k
                points.append(add(add(p, side, 0.30 * length * k), up, 0.30 * length * lift))
                uvs.append((0.5 + 0.5 * k, i / 6))
            p = add(p, heading(azimuth, pitch), length / 6)
        faces = []
        for i in range(6):
            for k in range(2):
                a = 3 * i + k
                faces += [(a, a + 1, a + 4), (a, a + 4, a + 3)]
        self.piece("leaf", points, faces, uvs)

    def fruit(self, material, top, diameter, length, lobes, phase, tilt):
        """A closed blocky body that hangs from `top`."""
        rings, sides = 11, 20
        axis = unit((tilt[0], tilt[1], -1.0))
        x = unit(cross(axis, (0.9, 0.1, 0.2)))
        y = cross(axis, x)
        points, faces = [top], []
        for i in range(1, rings):
            t = math.pi * i / rings
            radius = 0.5 * diameter * math.sin(t) ** 0.75 * (1.06 - 0.10 * i / rings)
            along = 0.5 * length * (1 - math.cos(t)) - 0.06 * length * math.exp(-((t / 0.5) ** 2))
            for k in range(sides):
                angle = 2 * math.pi * k / sides
                r = radius * (1 - 0.09 * (1 - abs(math.sin(0.5 * lobes * (angle - phase)))))
                points.append(add(add(add(top, axis, along), x, r * math.cos(angle)), y, r * math.sin(angle)))
        points.append(add(top, axis, 0.97 * length))
        last = len(points) - 1
        for k in range(sides):
            n = (k + 1) % sides
            faces.append((0, 1 + n, 1 + k))
            for i in range(rings - 2):
                a = 1 + i * sides
                faces += [(a + k, a + n, a + sides + n), (a + k, a + sides + n, a + sides + k)]
            faces.append((last, last - sides + k, last - sides + n))
        self.piece(material, points, faces)
        self.tube("calyx", [add(top, axis, -0.004), add(top, axis, 0.003)], [0.30 * diameter, 0.34 * diameter], 9)


def draw_plant(kind, rng):
    o, mesh = KINDS[kind], Mesh()
    height = rng.uniform(*o["height"])
    lean, turn = rng.uniform(0.0, 0.05), rng.uniform(0, 2 * math.pi)
    count = int(height / o["node"])
    axis = [(lean * height * (i / count) ** 2 * math.cos(turn) + rng.gauss(0, 0.003),
             lean * height * (i / count) ** 2 * math.sin(turn) + rng.gauss(0, 0.003), height * i / count)
            for i in range(count + 1)]
    mesh.tube("stem", axis, [0.011 - 0.008 * i / count for i in range(count + 1)], 8)
    azimuth, hanging = rng.uniform(0, 2 * math.pi), []
    for i in range(2, count + 1):
        node = axis[i]
        azimuth += 2.4
        young = max(0.35, min(1.0, (height - node[2]) / 0.30))
        for k in range(o["leaves"]):
            a = azimuth + 2 * math.pi * k / o["leaves"] + rng.gauss(0, 0.25)
            length = young * rng.uniform(*o["leaf"])
            end = add(node, heading(a, rng.gauss(0.35, 0.2)), 0.4 * length)
            mesh.tube("stem", [node, add(add(node, end), node, -1), end][::2], [0.003, 0.002], 5)
            mesh.leaf(end, a, length, (rng.gauss(0.3, 0.2), rng.gauss(-1.1, 0.25)), rng.gauss(0, 0.25))
        if node[2] < o["fruit_from"] or node[2] > height - 0.10 or rng.random() > o["chance"]:
            continue
        a = azimuth + rng.uniform(0.8, 2.4)
        colour = "fruit_green" if rng.random() < 0.16 else rng.choice(["fruit_red", "fruit_red", "fruit_orange"])
        for k in range(rng.randint(*o["truss"])):
            diameter, length = rng.uniform(*o["diameter"]), rng.uniform(*o["length"])
            place = a + (k % 2) * 0.9
            top = add(add(node, heading(place, 0.0), 0.62 * diameter + 0.022), (0, 0, -0.02 - 0.052 * k))
            centre = add(top, (0, 0, -0.5 * length))
            if any(math.dist(centre, other) < 0.5 * (diameter + size) + 0.006 for other, size in hanging):
                continue
            hanging.append((centre, max(diameter, length)))
            mesh.tube("stem", [node, add(top, (0, 0, 0.004))], [0.003, 0.0035], 5)
            mesh.fruit(colour, top, diameter, length, rng.choice([3, 4]), rng.uniform(0, 6.28),
                       (rng.gauss(0, 0.1), rng.gauss(0, 0.1)))
    return mesh


def write_model(folder, name, mesh, leaf_picture):
    meshes = folder / name / "meshes"
    meshes.mkdir(parents=True)
    shutil.copy(leaf_picture, meshes / "leaf.png")
    materials = "".join("newmtl %s\nKd %.3f %.3f %.3f\n" % (m, *c) for m, c in MATERIALS.items())
    (meshes / f"{name}.mtl").write_text(materials + "newmtl leaf\nKd 1 1 1\nmap_Kd leaf.png\n")
    (meshes / f"{name}.obj").write_text(f"mtllib {name}.mtl\n" + "\n".join(mesh.lines) + "\n")
    (folder / name / "model.config").write_text(
        f'<?xml version="1.0"?>\n<model><name>{name}</name><version>1.0</version><sdf version="1.6">model.sdf</sdf></model>\n')
    (folder / name / "model.sdf").write_text(
        f'<?xml version="1.0"?>\n<sdf version="1.6"><model name="{name}"><static>true</static><link name="link"><visual name="visual">'
        f"<geometry><mesh><uri>model://{name}/meshes/{name}.obj</uri></mesh></geometry></visual></link></model></sdf>\n")


def box(name, pose, size, colour):
    return (f'<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link"><visual name="visual"><geometry><box><size>{size}'
            f"</size></box></geometry><material><diffuse>{colour}</diffuse></material></visual></link></model>\n")


def write_world(folder, kind, seed, leaf_picture):
    """Two rows of plants, each its own mesh, with gutters, a floor and walls of other colours than ours."""
    rng, world = random.Random(seed), ""
    count, spacing = (5, 0.42) if kind == "bush" else (4, 0.5)
    for x, row in ((-0.75, "west"), (0.75, "east")):
        for i in range(count):
            name = f"{kind}_{row}_{i + 1}"
            write_model(folder / "models", name, draw_plant(kind, rng), leaf_picture)
            pose = "%.3f %.3f 0.06 0 0 %.3f" % (x + rng.gauss(0, 0.015), -1.0 + spacing * (i - 0.5 * (count - 1)) + rng.gauss(0, 0.02), rng.uniform(0, 6.28))
            world += f"<include><uri>model://{name}</uri><name>{name}</name><pose>{pose}</pose></include>\n"
        world += box(f"gutter_{row}", f"{x} -1.0 0.03 0 0 0", "0.2 2.4 0.06", "0.85 0.85 0.84 1")
    world += box("floor", "0 -1 -0.05 0 0 0", "8 8 0.1", "0.46 0.44 0.42 1")
    for x, side in ((-3.6, "west"), (3.6, "east")):
        world += box(f"wall_{side}", f"{x} -1 1.4 0 0 0", "0.05 8 2.8", "0.78 0.82 0.86 1")
    (folder / "world.sdf").write_text(f'<?xml version="1.0"?>\n<sdf version="1.6"><world name="{kind}">\n{world}</world></sdf>\n')
