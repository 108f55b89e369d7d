"""Writes shapes, materials, lights and cameras as glTF 2.0, as far as make_scenes.py needs them."""

import base64
import hashlib
import json
import math
import struct
import zlib


def rounded(x):
    """Rounds to six decimals, so that the last bit of the platform's sine does not change the bytes. (+0.0 turns -0.0
    into 0.0.)"""
    return round(x, 6) + 0.0


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def scaled(a, s):
    return tuple(x * s for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scaled(a, 1 / math.sqrt(dot(a, a)))


class Mesh:
    """Triangles, counter-clockwise seen from the front; without normals they are flat. Texture coordinates are for
    meshes that are added as they are."""

    def __init__(self, positions=(), triangles=(), normals=None, uvs=None):
        self.positions = list(positions)
        self.triangles = list(triangles)
        self.normals = normals
        self.uvs = uvs

    def __add__(self, other):
        assert self.normals is None and other.normals is None
        n = len(self.positions)
        moved = [tuple(i + n for i in t) for t in other.triangles]
        uvs = None if self.uvs is None or other.uvs is None else self.uvs + other.uvs
        return Mesh(self.positions + other.positions, self.triangles + moved, uvs=uvs)

    def flat(self):
        return Mesh(self.positions, self.triangles)

    def moved(self, offset):
        return Mesh([add(p, offset) for p in self.positions], self.triangles, self.normals, self.uvs)

    def turned(self, degrees):
        """Rotates about the y axis."""
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

        def turn(p):
            return (c * p[0] + s * p[2], p[1], c * p[2] - s * p[0])

        normals = self.normals and [turn(n) for n in self.normals]
        return Mesh([turn(p) for p in self.positions], self.triangles, normals)

    def inside_out(self):
        return Mesh(self.positions, [(a, c, b) for a, b, c in self.triangles],
                    self.normals and [scaled(n, -1) for n in self.normals])

    def divided(self, n):
        """Cuts each triangle into n² similar ones. Those of neighbours share the vertices on their common edge."""
        number = {}  # index of a vertex by its position to six decimals
        positions, triangles = [], []

        def vertex(corners, i, j):
            point = tuple((a * (n - i - j) + b * i + c * j) / n for a, b, c in zip(*corners))
            key = tuple(rounded(x) for x in point)
            if key not in number:
                number[key] = len(positions)
                positions.append(point)
            return number[key]

        for triangle in self.triangles:
            corners = [self.positions[v] for v in triangle]
            for i in range(n):
                for j in range(n - i):
                    triangles.append((vertex(corners, i, j), vertex(corners, i + 1, j), vertex(corners, i, j + 1)))
                    if i + j + 1 < n:
                        triangles.append((vertex(corners, i + 1, j), vertex(corners, i + 1, j + 1),
                                          vertex(corners, i, j + 1)))
        return Mesh(positions, triangles)

    def shuffled(self):
        """The same triangles in random order."""
        return Mesh(self.positions, sorted(self.triangles, key=lambda t: hashlib.md5(repr(t).encode()).digest()))


def quad(a, b, c, d):
    return Mesh([a, b, c, d], [(0, 1, 2), (0, 2, 3)])


def textured_quad(a, b, c, d, across=1, up=1):
    """A quad that shows an image so many times; its lower edge is from a to b."""
    return Mesh([a, b, c, d], [(0, 1, 2), (0, 2, 3)], uvs=[(0, up), (across, up), (across, 0), (0, 0)])


def box(low, high):
    """A closed box that faces outwards."""
    corners = [(low, high)[i & 1][0:1] + (low, high)[i >> 1 & 1][1:2] + (low, high)[i >> 2][2:3] for i in range(8)]
    faces = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return Mesh(corners, [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))])


def sphere(radius, frequency):
    """A smooth geodesic sphere of 20·frequency² similar triangles: an icosahedron's faces, divided and pushed outwards."""
    golden = (1 + math.sqrt(5)) / 2
    tops = [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0), (0, -1, golden), (0, 1, golden),
            (0, -1, -golden), (0, 1, -golden), (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]
    geodesic = Mesh(tops, faces).divided(frequency)
    normals = [tuple(rounded(x) for x in unit(point)) for point in geodesic.positions]
    return Mesh([scaled(n, radius) for n in normals], geodesic.triangles, normals)


def revolved(profile, segments):
    """A closed profile of (radius, height, normal's radius, normal's height), counter-clockwise seen with the radius to
    the right and the height up, rotated about the y axis; smooth. Triangles without area are left out."""
    positions, normals, triangles = [], [], []
    for s in range(segments):
        c, d = math.cos(2 * math.pi * s / segments), math.sin(2 * math.pi * s / segments)
        for radius, height, nr, nh in profile:
            positions.append((c * radius, height, d * radius))
            normals.append((c * nr, nh, d * nr))
    m = len(profile)
    for s in range(segments):
        here, there = s * m, (s + 1) % segments * m
        for p in range(m):
            q = (p + 1) % m
            triangles += [corners for corners in ((here + p, here + q, there + q), (here + p, there + q, there + p))
                          if len({positions[c] for c in corners}) == 3]
    return Mesh(positions, triangles, normals)


def lathed(corners, segments):
    """A body of revolution about the y axis with sharp edges. Its profile goes through (radius, height), from one point
    of the axis to another, with the body to the left."""
    profile = []
    for (r0, h0), (r1, h1) in zip(corners, corners[1:]):
        nr, nh, _ = unit((h1 - h0, r0 - r1, 0))
        profile += [(r0, h0, nr, nh), (r1, h1, nr, nh)]
    return revolved(profile, segments)


def crossing_quads(width, height, count):
    """Upright quads that cross in the y axis; each shows a whole image."""
    mesh = Mesh(uvs=[])
    for i in range(count):
        x, z = (width / 2 * turn(math.pi * i / count) for turn in (math.cos, math.sin))
        mesh += textured_quad((-x, 0, -z), (x, 0, z), (x, height, z), (-x, height, -z))
    return mesh


def lambertian(color):
    """A Lambertian material: a rough dielectric whose specular lobe is switched off."""
    return {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 1},
            "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}


def metal(color, roughness):
    return {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 1, "roughnessFactor": roughness}}


def glass(thickness, ior=1.5, roughness=0):
    """A solid that refracts. The thickness is the extent of the object; its surface is traced all the same."""
    return {"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0, "roughnessFactor": roughness},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                           "KHR_materials_volume": {"thicknessFactor": thickness},
                           "KHR_materials_ior": {"ior": ior}}}


def frosted_pane(color, roughness):
    """A thin wall."""
    return {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": roughness},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}}


def tinted(material, color, distance):
    """The same glass, in which white light has this color after this distance."""
    volume = {**material["extensions"]["KHR_materials_volume"],
              "attenuationColor": list(color), "attenuationDistance": distance}
    return {**material, "extensions": {**material["extensions"], "KHR_materials_volume": volume}}


def layered(material, extension, **values):
    """The same material with one extension more, say `clearcoat`."""
    return {**material, "extensions": {**material.get("extensions", {}), "KHR_materials_" + extension: values}}


def phong(diffuse, specular, exponent):
    """Modified Phong (Lafortune and Willems 1994; docs/materials.md)."""
    return {**lambertian(diffuse), "extras": {"phong": {"specular": [*specular], "exponent": exponent}}}


def blended(material, alpha):
    """The same material, alpha-blended."""
    color = material["pbrMetallicRoughness"]["baseColorFactor"][:3] + [alpha]
    return {**material, "alphaMode": "BLEND",
            "pbrMetallicRoughness": {**material["pbrMetallicRoughness"], "baseColorFactor": color}}


def cut_out(material, texture):
    """The same material on both sides, where the texture's alpha is at least a half."""
    return {**material, "alphaMode": "MASK", "doubleSided": True,
            "pbrMetallicRoughness": {**material["pbrMetallicRoughness"], "baseColorTexture": texture}}


def emitter(radiance, albedo=(0, 0, 0)):
    """Emits `radiance` from its front. glTF's emissive factor is at most 1; the strength supplies the rest."""
    strength = max(radiance)
    material = lambertian(albedo)
    material["emissiveFactor"] = [rounded(x / strength) for x in radiance]
    material["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
    return material


def png(rows):
    """The bytes of a PNG of rows of (red, green, blue), or with alpha too, 0 to 255. They are stored, so that no version
    of zlib changes them."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    lines = b"".join(b"\0" + bytes(sample for texel in row for sample in texel) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, {3: 2, 4: 6}[len(rows[0][0])], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 0)) +
            chunk(b"IEND", b""))


def rotation_towards(forward, up):
    """Quaternion (x, y, z, w) that turns -z to `forward` and y as close to `up` as can be."""
    z = scaled(unit(forward), -1)
    x = unit(cross(up, z))
    y = cross(z, x)
    m = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]
    # Of the four formulas, takes the one with the largest component: no square root of a small difference.
    t = [1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2], 1 - m[0][0] - m[1][1] + m[2][2],
         1 + m[0][0] + m[1][1] + m[2][2]]
    k = t.index(max(t))
    if k == 3:
        q = (m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], t[3])
    elif k == 0:
        q = (t[0], m[0][1] + m[1][0], m[0][2] + m[2][0], m[2][1] - m[1][2])
    elif k == 1:
        q = (m[0][1] + m[1][0], t[1], m[1][2] + m[2][1], m[0][2] - m[2][0])
    else:
        q = (m[0][2] + m[2][0], m[1][2] + m[2][1], t[2], m[1][0] - m[0][1])
    return [round(c, 9) + 0.0 for c in unit(q)]


class Scene:
    def __init__(self):
        self.nodes, self.meshes, self.materials, self.lights, self.cameras = [], [], [], [], []
        self.accessors, self.views, self.data = [], [], b""
        self.samplers, self.channels = [], []
        self.images, self.textures, self.texture_samplers = [], [], []

    def add(self, name, mesh, material, at=None, targets=()):
        """Adds a mesh, its origin `at` a place. Morph targets are meshes of offsets, without triangles."""
        self.materials.append({"name": name, **material})
        attributes = self._attributes(mesh)
        assert len(mesh.positions) < 65536
        indices = self._accessor([(i,) for t in mesh.triangles for i in t], 5123, "SCALAR", "H", 34963)
        primitive = {"attributes": attributes, "indices": indices, "material": len(self.materials) - 1}
        if targets:
            primitive["targets"] = [self._attributes(target) for target in targets]
        self.meshes.append({"name": name, "primitives": [primitive]})
        node = {"name": name, "mesh": len(self.meshes) - 1}
        self.nodes.append({**node, "translation": list(at)} if at else node)

    def _attributes(self, mesh):
        positions = [tuple(rounded(x) for x in p) for p in mesh.positions]
        attributes = {"POSITION": self._accessor(positions, 5126, "VEC3", "f", 34962)}
        if mesh.normals:
            normals = [tuple(rounded(x) for x in n) for n in mesh.normals]
            attributes["NORMAL"] = self._accessor(normals, 5126, "VEC3", "f", 34962)
        if mesh.uvs:
            attributes["TEXCOORD_0"] = self._accessor([tuple(uv) for uv in mesh.uvs], 5126, "VEC2", "f", 34962)
        return attributes

    def texture(self, rows, nearest=False):
        """Adds a texture of rows of texels, and returns what a material refers to it by."""
        self.data += b"\0" * (-len(self.data) % 4)
        image = png(rows)
        self.images.append({"bufferView": len(self.views), "mimeType": "image/png"})
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(image)})
        self.data += image
        kind = 9728 if nearest else 9729
        self.texture_samplers.append({"magFilter": kind, "minFilter": kind if nearest else 9987})
        self.textures.append({"source": len(self.images) - 1, "sampler": len(self.texture_samplers) - 1})
        return {"index": len(self.textures) - 1}

    def _accessor(self, rows, component, kind, code, target=None):
        self.data += b"\0" * (-len(self.data) % 4)
        packed = b"".join(struct.pack("<%d%s" % (len(row), code), *row) for row in rows)
        accessor = {"bufferView": len(self.views), "componentType": component, "count": len(rows), "type": kind}
        if code == "f":
            stored = list(struct.iter_unpack("<%df" % len(rows[0]), packed))
            accessor["min"] = [min(column) for column in zip(*stored)]
            accessor["max"] = [max(column) for column in zip(*stored)]
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)}
        self.views.append({**view, "target": target} if target else view)
        self.data += packed
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def camera(self, position, target, degrees=40, up=(0, 1, 0), aspect=1):
        """`degrees` is the vertical angle of view."""
        self.cameras.append({"name": "camera", "type": "perspective",
                             "perspective": {"yfov": rounded(math.radians(degrees)), "aspectRatio": aspect,
                                             "znear": 0.01}})
        forward = add(target, scaled(position, -1))
        self.nodes.append({"name": "camera", "camera": len(self.cameras) - 1, "translation": list(position),
                           "rotation": rotation_towards(forward, up)})

    def light(self, kind, intensity, position=None, towards=None, cones=None, color=(1, 1, 1)):
        """Candela (point, spot) or lux (directional); `cones` are the inner and outer half angles in degrees."""
        light = {"name": kind, "type": kind, "color": list(color), "intensity": intensity}
        if cones:
            light["spot"] = {"innerConeAngle": rounded(math.radians(cones[0])),
                             "outerConeAngle": rounded(math.radians(cones[1]))}
        node = {"name": kind, "extensions": {"KHR_lights_punctual": {"light": len(self.lights)}}}
        if position:
            node["translation"] = list(position)
        if towards:
            node["rotation"] = rotation_towards(towards, (0, 0, -1) if abs(towards[1]) > abs(towards[2]) else (0, 1, 0))
        self.lights.append(light)
        self.nodes.append(node)

    def animate(self, name, path, keys, step=False):
        """Changes the translation, rotation, scale or morph weights of the node with this name. Keys are pairs of a
        time in seconds and a value; between them values change linearly, or in steps. At rest the node has the first
        value."""
        index = [node["name"] for node in self.nodes].index(name)
        values = [tuple(rounded(x) for x in value) for _, value in keys]
        self.nodes[index][path] = list(values[0])
        times = self._accessor([(rounded(time),) for time, _ in keys], 5126, "SCALAR", "f")
        if path == "weights":
            output = self._accessor([(x,) for value in values for x in value], 5126, "SCALAR", "f")
        else:
            output = self._accessor(values, 5126, "VEC%d" % len(values[0]), "f")
        self.channels.append({"sampler": len(self.samplers), "target": {"node": index, "path": path}})
        sampler = {"input": times, "output": output}
        self.samplers.append({**sampler, "interpolation": "STEP"} if step else sampler)

    def document(self):
        extensions = {name for material in self.materials for name in material.get("extensions", {})}
        document = {"asset": {"version": "2.0", "generator": "Argand make_scenes.py"}}
        if self.lights:
            extensions.add("KHR_lights_punctual")
            document["extensions"] = {"KHR_lights_punctual": {"lights": self.lights}}
        document["extensionsUsed"] = sorted(extensions)
        document["scene"] = 0
        document["scenes"] = [{"nodes": list(range(len(self.nodes)))}]
        for key, value in (("nodes", self.nodes), ("meshes", self.meshes), ("materials", self.materials),
                           ("cameras", self.cameras), ("accessors", self.accessors), ("bufferViews", self.views),
                           ("images", self.images), ("textures", self.textures),
                           ("samplers", self.texture_samplers)):
            if value:
                document[key] = value
        if self.channels:
            document["animations"] = [{"samplers": self.samplers, "channels": self.channels}]
        document["buffers"] = [{"byteLength": len(self.data)}]
        return document

    def gltf(self):
        """The bytes of a readable .gltf with embedded data."""
        document = self.document()
        document["buffers"][0]["uri"] = ("data:application/octet-stream;base64," +
                                         base64.b64encode(self.data).decode("ascii"))
        return (json.dumps(document, indent=1) + "\n").encode("ascii")

    def glb(self):
        """The bytes of a binary .glb."""
        text = json.dumps(self.document(), separators=(",", ":")).encode("ascii")
        text += b" " * (-len(text) % 4)
        data = self.data + b"\0" * (-len(self.data) % 4)
        size = 12 + 8 + len(text) + 8 + len(data)
        return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text +
                struct.pack("<I4s", len(data), b"BIN\0") + data)
