#!/usr/bin/env python3
"""Writes the scenes of this folder to it, or to the folder given. The bytes are always the same.

    python3 assets/make_scenes.py [FOLDER]

Lengths are in metres, y is up. Intensities are such that exposure 0 shows the pictures well.
"""

import math
import pathlib
import sys

from gltf_writer import (Mesh, Scene, add, blended, box, cross, crossing_quads, cut_out, emitter, frosted_pane, glass,
                         lambertian, lathed, layered, metal, phong, quad, revolved, rotation_towards, scaled, sphere,
                         textured_quad, tinted, unit)

WHITE, RED, GREEN, WOOD = (0.725, 0.71, 0.68), (0.63, 0.065, 0.05), (0.14, 0.45, 0.091), (0.63, 0.3, 0.1)
ROOM, SHELL = ((-2, 0, -2), (2, 2.5, 2)), ((-2.2, -0.04, -2.2), (2.2, 2.7, 2.2))
SUNK = 0.01  # bodies reach this far into the floor, so that they are closed without a face in its plane


def ceiling(x0, x1, z0, z1, y=2):
    return quad((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))


def cornell(light=False, cut=lambda mesh: mesh):
    """The empty Cornell box (after Goral et al.), 2 × 2 × 2, open towards the camera in front of it, with or without a
    light set flush into the ceiling. `cut` changes the triangles of walls."""
    scene = Scene()
    l, r, b, t, n, f = -1, 1, 0, 2, 1, -1

    def wall(name, mesh, color=WHITE):
        scene.add(name, cut(mesh), lambertian(color))

    wall("floor", quad((l, b, n), (r, b, n), (r, b, f), (l, b, f)))
    if light:
        x, z, strength = 0.25, 0.2, 22
        wall("ceiling, back", ceiling(l, r, f, -z))
        wall("ceiling, front", ceiling(l, r, z, n))
        wall("ceiling, left", ceiling(l, -x, -z, z))
        wall("ceiling, right", ceiling(x, r, -z, z))
        scene.add("light", ceiling(-x, x, -z, z), emitter((strength, 0.86 * strength, 0.68 * strength)))
    else:
        wall("ceiling", ceiling(l, r, f, n))
    wall("back wall", quad((l, b, f), (r, b, f), (r, t, f), (l, t, f)))
    wall("left wall", quad((l, b, n), (l, b, f), (l, t, f), (l, t, n)), RED)
    wall("right wall", quad((r, b, f), (r, b, n), (r, t, n), (r, t, f)), GREEN)
    scene.camera((0, 1, 3.72), (0, 1, 0))
    return scene


def tall_box(degrees=18):
    return box((-0.3, -SUNK, -0.3), (0.3, 1.2, 0.3)).turned(degrees).moved((-0.35, 0, -0.35))


def short_box():
    return box((-0.3, -SUNK, -0.3), (0.3, 0.6, 0.3)).turned(-17).moved((0.35, 0, 0.3))


def resting_sphere(radius, x, z, frequency=12):
    return sphere(radius, frequency).moved((x, radius + SUNK, z))


def add_boxes(scene):
    scene.add("tall box", tall_box(), lambertian(WHITE))
    scene.add("short box", short_box(), lambertian(WHITE))


def cornell_point():
    scene = cornell()
    add_boxes(scene)
    scene.light("point", 2, (0, 1.5, 0.1))
    return scene


def cornell_area():
    scene = cornell(light=True)
    add_boxes(scene)
    return scene


def cornell_glass():
    scene = cornell(light=True)
    scene.add("tall box", tall_box(), lambertian(WHITE))
    scene.add("glass sphere", resting_sphere(0.4, 0.35, 0.3), glass(0.8))
    return scene


def frosted_glass():
    scene = cornell(light=True)
    scene.add("tall box", tall_box(), lambertian(WHITE))
    scene.add("frosted sphere", resting_sphere(0.4, 0.35, 0.3), glass(0.8, roughness=0.4))
    scene.add("frosted pane", quad((-0.75, 0.05, 0.75), (-0.15, 0.05, 0.55), (-0.15, 1.1, 0.55), (-0.75, 1.1, 0.75)),
              frosted_pane((0.6, 0.85, 0.95), 0.35))
    return scene


def cornell_mirror():
    scene = cornell(light=True)
    # Turned so that the camera sees the room in it, not the darkness in front of the box.
    scene.add("mirror", tall_box(40), metal((0.95, 0.95, 0.95), 0))
    scene.add("short box", short_box(), lambertian(WHITE))
    return scene


def rounded_ring(inner, outer, low, high, bevel, steps=4):
    """A ring about the y axis, with a rectangle of rounded corners as its profile."""
    profile = []
    for start, r, h in ((0, outer - bevel, high - bevel), (90, inner + bevel, high - bevel),
                        (180, inner + bevel, low + bevel), (270, outer - bevel, low + bevel)):
        for step in range(steps + 1):
            a = math.radians(start + 90 * step / steps)
            profile.append((r + bevel * math.cos(a), h + bevel * math.sin(a), math.cos(a), math.sin(a)))
    return revolved(profile, 96)


def plane_with_ring():
    scene = Scene()
    scene.add("plane", quad((-4, 0, 4), (4, 0, 4), (4, 0, -4), (-4, 0, -4)), lambertian((0.8, 0.8, 0.8)))
    scene.add("ring", rounded_ring(1.0, 1.08, -SUNK, 0.45, 0.025), metal((0.95, 0.79, 0.45), 0))
    return scene


def ring():
    """The cardioid caustic of a metal ring (after the Ring of Fabianowski and Dingliana 2009)."""
    scene = plane_with_ring()
    scene.light("point", 22, (2.6, 1.9, 0))
    scene.camera((0, 4, 2.2), (0, 0, 0))
    return scene


def plane_point():
    """A point light of 2 cd, 1 m above an albedo of 0.5: L = ρ/π · I · cosθ / d², 0.318 straight below."""
    scene = Scene()
    scene.add("plane", quad((-5, 0, 5), (5, 0, 5), (5, 0, -5), (-5, 0, -5)), lambertian((0.5, 0.5, 0.5)))
    scene.light("point", 2, (0, 1, 0))
    scene.camera((0, 3, 0), (0, 0, 0), up=(0, 0, -1))
    return scene


def furnace():
    """Under a uniform sky (--env 1,1,1) an albedo of 1 is invisible, exactly so with flat facets."""
    scene = Scene()
    scene.add("sphere", sphere(1, 12).flat(), lambertian((1, 1, 1)))
    scene.camera((0, 0, 4), (0, 0, 0))
    return scene


def closed_box():
    """Six walls that emit 0.25 and reflect 0.5, with the camera inside: L = 0.25 / (1 - 0.5) = 0.5 everywhere."""
    scene = Scene()
    scene.add("walls", box((-1, -1, -1), (1, 1, 1)).inside_out(), emitter((0.25, 0.25, 0.25), (0.5, 0.5, 0.5)))
    scene.camera((0.3, -0.2, 0.5), (-1, 0.6, -1), degrees=60)
    return scene


def glossy():
    scene = cornell(light=True)
    scene.add("steel box", tall_box(40), metal((0.8, 0.8, 0.82), 0.2))
    scene.add("gold sphere", resting_sphere(0.4, 0.35, 0.3), metal((1.0, 0.78, 0.34), 0.5))
    return scene


def veil():
    """A box of modified Phong behind an alpha-blended pane."""
    scene = cornell(light=True)
    scene.add("plastic box", tall_box(40), phong((0.3, 0.35, 0.4), (0.55, 0.5, 0.45), 60))
    scene.add("short box", short_box(), lambertian(WHITE))
    pane = quad((-0.9, 0.02, 0.75), (0.5, 0.02, 0.75), (0.5, 1.3, 0.75), (-0.9, 1.3, 0.75))
    scene.add("pane", pane, blended(lambertian((0.2, 0.5, 0.7)), 0.4))
    return scene


def slope_texel(x, y):
    """A texel of a normal texture: parts of the normal along u, and upwards in the image."""
    return tuple(round(128 + 127 * part) for part in (x, y, math.sqrt(1 - x * x - y * y)))


def textures():
    """A lamp that shines by its texels over a checkerboard, before a wall of waves, with a sphere of metal that is
    polished in squares. All repeat their images; that of the lamp has one row."""
    scene = Scene()
    board = scene.texture([[(225, 215, 200), (40, 60, 110)], [(40, 60, 110), (225, 215, 200)]], nearest=True)
    floor = lambertian((1, 1, 1))
    floor["pbrMetallicRoughness"]["baseColorTexture"] = board
    scene.add("floor", textured_quad((-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1), 4, 4), floor)
    waves = [[slope_texel(0.7 * math.sin(2 * math.pi * x / 16), 0.5 * math.cos(2 * math.pi * y / 16))
              for x in range(16)] for y in range(16)]
    wall = lambertian(WHITE)
    wall["normalTexture"] = scene.texture(waves)
    scene.add("back wall", textured_quad((-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1), 3, 3), wall)
    scene.add("left wall", quad((-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)), lambertian(RED))
    scene.add("right wall", quad((1, 0, -1), (1, 0, 1), (1, 2, 1), (1, 2, -1)), lambertian(GREEN))
    scene.add("ceiling", ceiling(-1, 1, -1, 1), lambertian(WHITE))
    lamp = emitter((14, 14, 14))
    lamp["emissiveTexture"] = scene.texture([[(255, 80, 40), (0, 0, 0), (255, 240, 200), (0, 0, 0), (60, 120, 255)]],
                                            nearest=True)
    scene.add("lamp", textured_quad((-0.6, 1.98, -0.3), (0.6, 1.98, -0.3), (0.6, 1.98, 0.3), (-0.6, 1.98, 0.3)), lamp)
    ball = sphere(0.4, 8)
    ball.uvs = [(0.5 + 0.5 * n[0], 0.5 - 0.5 * n[1]) for n in ball.normals]  # projected along z
    polished = metal((0.95, 0.8, 0.5), 1)
    polished["pbrMetallicRoughness"]["metallicRoughnessTexture"] = scene.texture(
        [[(0, 30 if (x + y) % 2 else 140, 255) for x in range(8)] for y in range(4)], nearest=True)
    scene.add("ball", ball.moved((0.25, 0.4 + SUNK, 0.2)), polished)
    scene.camera((0, 1, 3.72), (0, 1, 0))
    return scene


def leaf_texel(x, y):
    """A texel of three leaves on a stalk, cut out by alpha. x, y: -1 to 1, y upwards."""
    stalk = abs(x) < 0.04 and y < 0.4
    leaves = any(((x - cx) * c + (y - cy) * s) ** 2 / 0.36 + ((y - cy) * c - (x - cx) * s) ** 2 / 0.03 < 1
                 for cx, cy, c, s in ((0, 0.38, 0, 1), (-0.48, -0.1, 0.8, -0.6), (0.48, -0.1, 0.8, 0.6)))
    green = round(140 + 60 * y)
    return (60, green, 50, 255 if stalk or leaves else 0)


def cutouts():
    """A lantern throws the pattern of its holes on the walls. Alpha cuts out these and the leaves of a plant, and lets
    light through a pane whose alpha comes from a texture."""
    scene = cornell()
    scene.light("point", 2.4, (-0.3, 1.2, -0.1))
    holes = scene.texture([[(150, 90, 50, 0 if (x - 3.5) ** 2 + (y - 3.5) ** 2 < 7 else 255) for x in range(8)]
                           for y in range(8)], nearest=True)
    low, high = (-0.5, 1, -0.3), (-0.1, 1.4, 0.1)
    lantern = Mesh(uvs=[])
    for x, z, u, v in ((0, 1, 1, 1), (1, 1, 1, 0), (1, 0, 0, 0), (0, 0, 0, 1)):  # from this corner to that
        (a, b), (c, d) = (((low, high)[i][0], (low, high)[j][2]) for i, j in ((x, z), (u, v)))
        lantern += textured_quad((a, low[1], b), (c, low[1], d), (c, high[1], d), (a, high[1], b), 3, 3)
    scene.add("lantern", lantern, cut_out(lambertian((1, 1, 1)), holes))
    leaves = scene.texture([[leaf_texel((x - 31.5) / 32, (31.5 - y) / 32) for x in range(64)] for y in range(64)])
    scene.add("plant", crossing_quads(0.9, 0.9, 3).moved((0.35, 0, 0.2)), cut_out(lambertian((1, 1, 1)), leaves))
    fading = scene.texture([[(90, 160, 220, 16 * x) for x in range(16)]])
    pane = blended(lambertian((1, 1, 1)), 0.9)
    pane["pbrMetallicRoughness"]["baseColorTexture"] = fading
    scene.add("pane", textured_quad((-0.95, 0.02, 0.6), (-0.2, 0.02, 0.75), (-0.2, 0.8, 0.75), (-0.95, 0.8, 0.6)), pane)
    return scene


def tinted_glass():
    """Three bodies of glass that absorb light on the way through them: the same amber, thick and thin, and blue."""
    scene = cornell(light=True)
    amber = tinted(glass(0.5), (0.95, 0.55, 0.12), 0.25)
    scene.add("thick amber", resting_sphere(0.36, 0.42, 0.3), amber)
    scene.add("thin amber", resting_sphere(0.12, -0.05, 0.7), amber)
    scene.add("blue block", box((-0.3, SUNK, -0.3), (0.3, 1.1, 0.3)).turned(25).moved((-0.4, 0, -0.3)),
              tinted(glass(0.6), (0.25, 0.5, 0.95), 0.4))
    return scene


def drink():
    """A tumbler with tea that reaches into its walls, and an ice cube that swims in it: solids in one another."""
    scene = cornell(light=True)
    outer, inner, base, top, level = 0.42, 0.36, 0.1, 1.1, 0.8
    within = (inner + outer) / 2  # how far the tea reaches
    place = (0.15, -SUNK, 0.2)
    tumbler = lathed([(0, 0), (outer, 0), (outer, top), (inner, top), (inner, base), (0, base)], 64)
    tea = lathed([(0, base / 2), (within, base / 2), (within, level), (0, level)], 64)
    scene.add("tumbler", tumbler.moved(place), glass(0.06))
    scene.add("tea", tea.moved(place), tinted(glass(0.7, ior=1.33), (0.9, 0.5, 0.15), 0.4))
    scene.add("ice", box((-0.15, 0.62, -0.15), (0.15, 0.92, 0.15)).turned(30).moved(place), glass(0.3, ior=1.31))
    scene.add("cherry", sphere(0.12, 8).moved((0.3, 0.3, 0.25)), lambertian(RED))
    scene.add("tall box", tall_box().moved((-0.2, 0, -0.15)), lambertian(WHITE))
    return scene


def varnish():
    """What glTF adds to a surface: a clear coat on hammered metal, sheen on cloth, brushed metal, and an iridescent
    film. Images are projected onto the spheres along z."""
    scene = cornell(light=True)
    dents = scene.texture([[slope_texel(0.35 * math.sin(2 * math.pi * x / 16), 0.35 * math.sin(2 * math.pi * y / 16))
                            for x in range(16)] for y in range(16)])
    hammered = layered(metal((0.9, 0.35, 0.25), 0.4), "clearcoat", clearcoatFactor=1, clearcoatRoughnessFactor=0.1)
    hammered["normalTexture"] = dents
    cloth = layered(lambertian((0.12, 0.04, 0.2)), "sheen", sheenColorFactor=[0.8, 0.7, 0.9], sheenRoughnessFactor=0.4)
    brushed = layered(metal((0.85, 0.8, 0.7), 0.5), "anisotropy", anisotropyStrength=0.9, anisotropyRotation=0.5)
    film = layered(metal((0.6, 0.6, 0.6), 0.3), "iridescence", iridescenceFactor=1, iridescenceIor=1.6,
                   iridescenceThicknessMinimum=400, iridescenceThicknessMaximum=400)
    scene.add("shelf", box((-0.95, -SUNK, -0.95), (0.95, 0.75, -0.1)), lambertian(WHITE))
    for name, material, x, y, z in (("hammered, coated", hammered, -0.45, 0.75, -0.5), ("cloth", cloth, 0.45, 0.75, -0.5),
                                    ("brushed", brushed, -0.42, 0, 0.55), ("film", film, 0.42, 0, 0.55)):
        ball = sphere(0.36, 10)
        ball.uvs = [(2 + 2 * n[0], 2 - 2 * n[1]) for n in ball.normals]
        scene.add(name, ball.moved((x, y + 0.36 + SUNK, z)), material)
    return scene


def smooth_sphere():
    """A sphere of 80 triangles, so coarse that its interpolated normals are far from those of its faces."""
    scene = cornell(light=True)
    scene.add("coarse sphere", resting_sphere(0.5, 0, 0, frequency=2), lambertian(WHITE))
    return scene


def inside_glass():
    """The camera is inside a glass sphere and looks out of it at a box."""
    scene = cornell(light=True)
    add_boxes(scene)
    scene.add("glass sphere", sphere(0.3, 12).moved((0.25, 1.25, 0.6)), glass(0.6))
    scene.nodes = [node for node in scene.nodes if "camera" not in node]
    scene.cameras = []
    scene.camera((0.25, 1.2, 0.75), (-0.05, 0.75, -0.3), degrees=90)
    return scene


def sky_room():
    """Without a light of its own: the sky comes in through the open front (--env 1,1,1)."""
    scene = cornell()
    add_boxes(scene)
    return scene


def spot():
    """A spot under the ceiling points at the floor in front of the red wall; these two light the rest."""
    scene = cornell()
    add_boxes(scene)
    scene.light("spot", 14, (0.5, 1.9, 0.7), towards=(-0.9, -1.3, -0.35), cones=(20, 32), color=(1, 0.95, 0.85))
    return scene


def courtyard():
    """A yard open to the sun, with a colonnade along its back."""
    scene = Scene()
    ground, x, z, top = 0, 3, 3, 2.4
    scene.add("ground", quad((-x, ground, z), (x, ground, z), (x, ground, -z), (-x, ground, -z)),
              lambertian((0.6, 0.55, 0.47)))
    walls = (quad((-x, ground, -z), (x, ground, -z), (x, top, -z), (-x, top, -z)) +
             quad((x, ground, -z), (x, ground, z), (x, top, z), (x, top, -z)))
    scene.add("walls", walls, lambertian((0.75, 0.7, 0.6)))
    scene.add("painted wall", quad((-x, ground, z), (-x, ground, -z), (-x, top, -z), (-x, top, z)),
              lambertian((0.6, 0.16, 0.08)))
    column = box((-0.14, -SUNK, -0.14), (0.14, 1.7, 0.14))
    columns = Mesh()
    for i in range(5):
        columns += column.moved((-2.2 + 1.1 * i, 0, -1.7))
    scene.add("columns", columns, lambertian((0.8, 0.78, 0.72)))
    scene.add("roof", box((-2.9, 1.71, -2.95), (2.9, 1.87, -1.45)), lambertian((0.35, 0.18, 0.12)))
    scene.add("basin", box((-0.7, -SUNK, 0.1), (0.7, 0.35, 1.2)), lambertian((0.7, 0.7, 0.72)))
    scene.light("directional", 3.2, towards=(-0.55, -1, -0.5), color=(1, 0.93, 0.8))
    scene.camera((1.3, 2.9, 4.2), (-0.35, 0.35, -0.8), degrees=42)
    return scene


def room(strength=20, paint=lambertian, low=ROOM[0]):
    """A closed room of 4 × 4 × 2.5 m with a table and a lamp under the ceiling (unless its strength is 0), seen from a
    corner. It is larger with another low end."""
    scene = Scene()
    scene.add("room", box(low, ROOM[1]).inside_out(), paint(WHITE))
    scene.add("table", box((-0.5, -SUNK, -0.8), (0.6, 0.7, 0.2)), paint(WOOD))
    if strength:
        scene.add("lamp", ceiling(-0.3, 0.3, -0.3, 0.3, 2.49), emitter(scaled((1, 0.9, 0.75), strength)))
    scene.camera((1.7, 1.5, 1.7), (-0.6, 0.7, -0.7), degrees=70)
    return scene


def add_ground(scene):
    scene.add("ground", quad((-100, -0.05, 100), (100, -0.05, 100), (100, -0.05, -100), (-100, -0.05, -100)),
              lambertian((0.4, 0.4, 0.35)))


def closed_room():
    return room()


def sunlit_ground():
    """The closed room in a shell on 200 m of ground, under a sun that does not come in."""
    scene = room()
    add_ground(scene)
    scene.add("shell", box(*SHELL), lambertian(WHITE))
    scene.light("directional", 1e5, towards=(-0.5, -1, -0.4))
    return scene


def among_forty(scene):
    """A room and 39 others like it. Only the first is seen."""
    furnished = [node for node in scene.nodes if "mesh" in node]
    for i in range(1, 40):
        scene.nodes += [{**node, "name": f"{node['name']} {i}", "translation": [5 * (i % 8), 0, 5 * (i // 8)]}
                        for node in furnished]
    return scene


def forty_rooms():
    """The closed room among forty."""
    return among_forty(room())


def forty_bulbs():
    """The room with the bulb among forty. Shadow rays end at the glass, and do not tell which lamp is in view."""
    return among_forty(bulb())


def two_rooms():
    """The closed room, one wall of which hides a room with a lamp 100 times as strong. Floor, ceiling and two walls go on
    behind it."""
    (left, bottom, back), (_, top, front) = ROOM
    scene = room(low=(left - 4.1, bottom, back))
    scene.add("wall", box((left - 0.1, bottom - SUNK, back - SUNK), (left, top + SUNK, front + SUNK)), lambertian(WHITE))
    scene.add("bright lamp", ceiling(left - 2.4, left - 1.8, -0.3, 0.3, 2.49), emitter(scaled((1, 0.9, 0.75), 2000)))
    return scene


def with_window(low, high, y0, y1, z):
    """A box that faces outwards, with an opening in its wall at the greatest x: from y0 to y1 and from -z to z."""
    mesh = box(low, high)
    del mesh.triangles[2:4]  # that wall
    for bottom, top, left, right in ((low[1], y0, low[2], high[2]), (y1, high[1], low[2], high[2]),
                                     (y0, y1, low[2], -z), (y0, y1, z, high[2])):
        mesh += quad((high[0], bottom, right), (high[0], bottom, left), (high[0], top, left), (high[0], top, right))
    return mesh


def window_room():
    """A room with a window of 1.3 m², which the sun and the sunlit ground light."""
    y0, y1, z = 0.9, 2, 0.6
    scene = Scene()
    add_ground(scene)
    scene.add("room", with_window(*ROOM, y0, y1, z).inside_out(), lambertian(WHITE))
    scene.add("shell", with_window(*SHELL, y0, y1, z), lambertian(WHITE))
    inner, outer = ROOM[1][0], SHELL[1][0]
    reveal = box((inner, y0, -z), (outer, y1, z)).inside_out()
    del reveal.triangles[:4]  # the opening's ends
    scene.add("reveal", reveal, lambertian(WHITE))
    scene.add("table", box((-0.5, -SUNK, -0.8), (0.6, 0.7, 0.2)), lambertian(WOOD))
    scene.light("directional", 60, towards=(-1, -0.8, 0.1), color=(1, 0.93, 0.8))
    scene.camera((-1.7, 1.5, 1.7), (0.6, 0.7, -0.7), degrees=75)
    return scene


def glazed_room():
    """The same room with a thin pane in the window, at which shadow rays end."""
    scene = window_room()
    x, y0, y1, z = 2.03, 0.9, 2, 0.6
    scene.add("pane", quad((x, y0, z), (x, y0, -z), (x, y1, -z), (x, y1, z)), frosted_pane((1, 1, 1), 0))
    return scene


def blind():
    """A room with a lamp, and a closed blind of white slats in its sunlit window. They overlap, 3 mm from one to the next."""
    scene = window_room()
    scene.add("lamp", ceiling(-0.3, 0.3, -0.3, 0.3, 2.49), emitter(scaled((1, 0.9, 0.75), 20)))
    upright = box((-0.0008, -0.015, -0.62), (0.0008, 0.015, 0.62))
    slat = Mesh([(x + 0.15 * y, y, z) for x, y, z in upright.positions], upright.triangles)
    slats = Mesh()
    for i in range(58):
        slats += slat.moved((1.98, 0.88 + 0.02 * i, 0))
    scene.add("blind", slats, lambertian((0.8, 0.8, 0.78)))
    return scene


def marble(scale):
    """A glass marble of 4 cm on a table, and its caustic, in a room `scale` times as large as one of 6 m. The room is
    scaled about the marble's foot, so that the picture is nearly the same."""
    scene = Scene()

    def about(low, high):
        return box(scaled(low, scale), scaled(high, scale))

    scene.add("room", about((-3, -0.75, -3), (3, 2.05, 3)).inside_out(), lambertian(WHITE))
    scene.add("table", about((-0.6, -0.75 - SUNK, -0.6), (0.6, 0, 0.6)), lambertian((0.63, 0.5, 0.3)))
    x, z, half = 0.9 * scale, -0.5 * scale, 0.2 * scale
    scene.add("lamp", ceiling(x - half, x + half, z - half, z + half, 2.04 * scale), emitter((60, 54, 45)))
    scene.add("marble", sphere(0.02, 12).moved((0, 0.0202, 0)), glass(0.04))
    scene.camera((0.01, 0.095, 0.11), (-0.006, 0.004, 0.002), degrees=45)
    return scene


def glass_marble():
    return marble(1)


def marble_box():
    """The marble's twin, in a box of 0.6 m."""
    return marble(0.1)


def bulb():
    """A lamp inside a bulb of glass: all light is a caustic."""
    scene = room(strength=0)
    centre = (-0.2, 1.5, -0.3)
    scene.add("lamp", sphere(0.25, 4).moved(centre), emitter((12, 10.8, 9)))
    scene.add("bulb", sphere(0.35, 10).moved(centre), glass(0.02))
    scene.add("bulb, inside", sphere(0.33, 10).inside_out().moved(centre), glass(0.02))
    return scene


def small_emitters():
    """Strings of 512 beads along the ceiling, small tetrahedra that emit light of eight colours."""
    scene = room(strength=0)
    corners = ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))
    bead = Mesh([scaled(c, 0.006) for c in corners], [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])
    strings = [Mesh() for _ in range(8)]
    for i in range(512):
        string, place = i % 16, i // 16 / 31  # both along and across, from wall to wall
        x, z = -1.8 + 3.6 * place, -1.8 + 3.6 * string / 15
        strings[string // 2] += bead.turned(37 * i).moved((x, 2.4 - 1.2 * place * (1 - place), z))
    for i, color in enumerate(((1, 0.25, 0.15), (1, 0.6, 0.2), (1, 0.9, 0.5), (0.3, 1, 0.3), (0.2, 0.8, 1), (0.25, 0.35, 1),
                               (0.8, 0.3, 1), (1, 0.4, 0.7))):
        scene.add(f"beads {i}", strings[i], emitter(scaled(color, 30 + 10 * i)))
    return scene


def dark_room():
    """The closed room, painted nearly black."""
    return room(strength=400, paint=lambda color: lambertian((0.02, 0.02, 0.02)))


def gloss_only():
    """The closed room of rough metals. No surface is diffuse."""
    return room(paint=lambda color: metal(color, 0.4 if color == WHITE else 0.2))


def shuffled_walls():
    """cornell_area, its walls cut into small triangles in random order."""
    scene = cornell(light=True, cut=lambda mesh: mesh.divided(16).shuffled())
    add_boxes(scene)
    return scene


def moving_light():
    """A point light that circles above a glass sphere once in two seconds."""
    scene = cornell()
    scene.add("tall box", tall_box(), lambertian(WHITE))
    scene.add("glass sphere", resting_sphere(0.4, 0.35, 0.3), glass(0.8))
    circle = [(0.55 * math.cos(math.pi * k / 16), 1.6, 0.15 + 0.55 * math.sin(math.pi * k / 16)) for k in range(33)]
    scene.light("point", 2, circle[0])
    scene.animate("point", "translation", [(k / 16, place) for k, place in enumerate(circle)])
    return scene


def frame(k):
    """The time of frame k, at 24 frames per second."""
    return k / 24


def panel(half, towards):
    """A square about the origin that faces a direction other than z."""
    x = scaled(unit(cross((0, 0, 1), towards)), half)
    y = scaled(unit(cross(towards, x)), half)
    return quad(scaled(add(x, y), -1), add(x, scaled(y, -1)), add(x, y), add(y, scaled(x, -1)))


def lamp(strength):
    return emitter(scaled((1, 0.9, 0.75), strength))


def dynamic_shi():
    """A point light that crosses a closed room in three frames and comes back, as in Shi (2012)."""
    scene = Scene()
    l, r, b, t, n, f = -8, 8, 0, 12, 8, -8
    scene.add("room", box((l, b, f), (r, t, n)).inside_out(), lambertian(WHITE))
    scene.add("tall box", box((-1.8, -SUNK, -1.8), (1.8, 6.5, 1.8)).turned(18).moved((-3.8, 0, -3.8)), lambertian(RED))
    scene.add("short box", box((-1.5, -SUNK, -1.5), (1.5, 2.6, 1.5)).turned(-17).moved((0.4, 0, 0.8)), lambertian(WOOD))
    scene.add("sphere", resting_sphere(2, 4.4, -3.2, 8), lambertian(GREEN))
    scene.light("point", 55)
    here, there = (-6, 10, 6), (6, 10, -6)
    scene.animate("point", "translation", [(frame(0), here), (frame(3), there), (frame(6), here)])
    scene.camera((0, 6.5, 7.8), (0, 4, -3.5), degrees=70)
    return scene


def dynamic_slow_light():
    """A lamp that crosses the Cornell box slowly, in 64 frames."""
    scene = cornell()
    add_boxes(scene)
    scene.add("lamp", ceiling(-0.15, 0.15, -0.15, 0.15, 0), lamp(65))
    scene.animate("lamp", "translation", [(frame(0), (-0.75, 1.9, 0.2)), (frame(63), (0.75, 1.9, 0.2))])
    return scene


def dynamic_switch():
    """A room with a weak lamp and a strong one, which is off from frame 4 to frame 7 of 12."""
    scene = room(strength=8)
    scene.add("switched lamp", ceiling(-0.2, 0.2, -0.2, 0.2, 0), emitter((45, 34, 22)), at=(-1.2, 2.49, -1))
    on, off = (1, 1, 1), (0, 0, 0)
    # It switches between frames, so that rounded times do not matter.
    scene.animate("switched lamp", "scale", [(frame(0), on), (frame(3.5), off), (frame(7.5), on), (frame(11), on)],
                  step=True)
    return scene


def dynamic_block():
    """A block that crosses the beam of a spot in 16 frames."""
    scene = cornell()
    add_boxes(scene)
    scene.light("spot", 17, (0, 1.95, 0.7), towards=(0, -1, -0.3), cones=(24, 36), color=(1, 0.95, 0.85))
    scene.add("block", box((-0.2, -0.1, -0.2), (0.2, 0.1, 0.2)), lambertian(WHITE))
    scene.animate("block", "translation", [(frame(0), (-0.78, 1.1, 0.4)), (frame(15), (0.78, 1.1, 0.4))])
    return scene


def dynamic_occluder():
    """The ring, with a plate that passes between the lamp and the ring in 16 frames."""
    scene = plane_with_ring()
    place = (2.6, 1.9, 0)
    scene.add("lamp", panel(0.18, scaled(place, -1)).moved(place), lamp(190))
    # Hides the polished bevels, which mirror the lamp into parts of pixels: fireflies in every method.
    scene.add("rim", rounded_ring(0.99, 1.09, 0.42, 0.46, 0.01), lambertian(WHITE))
    scene.add("plate", box((-0.02, -0.25, -0.25), (0.02, 0.25, 0.25)), lambertian(GREEN))
    scene.animate("plate", "translation", [(frame(0), (0.8, 1, -1.2)), (frame(15), (0.8, 1, 1.2))])
    scene.camera((0, 4, 2.2), (0, 0, 0))
    return scene


def water(half, n):
    """A flat surface of n × n squares at the height 0 that faces up."""
    points = [(half * (2 * i / n - 1), 0, half * (2 * j / n - 1)) for j in range(n + 1) for i in range(n + 1)]
    triangles = []
    for j in range(n):
        for i in range(n):
            back, front = j * (n + 1) + i, (j + 1) * (n + 1) + i
            triangles += [(front, front + 1, back + 1), (front, back + 1, back)]
    return Mesh(points, triangles, [(0, 1, 0)] * len(points))


def wave(surface, kx, kz, height, phase):
    """The offsets of a flat surface's positions and normals to a wave. The normals of sums of waves are exact."""
    angles = [kx * x + kz * z + phase for x, _, z in surface.positions]
    lifts = [(0, height * math.cos(a), 0) for a in angles]
    return Mesh(lifts, (), [(height * kx * math.sin(a), 0, height * kz * math.sin(a)) for a in angles])


def dynamic_water():
    """A pool whose waves throw caustics, for 16 frames: one wave travels, another rises and falls."""
    scene = Scene()
    scene.add("pool", box((-1, -0.8, -1), (1, 2, 1)).inside_out(), lambertian((0.35, 0.5, 0.52)))
    # Above the camera, where waves do not mirror it into the picture.
    scene.add("lamp", ceiling(-0.28, 0.28, 0.5, 0.98, 1.99), lamp(75))
    flat = water(1.02, 32)  # reaches into the walls
    travelling = (14, 7, 0.016)
    waves = [wave(flat, *travelling, 0), wave(flat, *travelling, -math.pi / 2), wave(flat, -7, 15, 0.009, 0.7)]
    scene.add("water", flat, glass(0.8, ior=1.33), targets=waves)
    turns = [2 * math.pi * k / 16 for k in range(16)]
    scene.animate("water", "weights", [(frame(k), (math.cos(a), math.sin(a), math.cos(a + 1)))
                                       for k, a in enumerate(turns)])
    scene.camera((0, 1.5, 0.95), (0, 0, -0.4), degrees=36)
    return scene


def dynamic_camera():
    """A camera that flies into the Cornell box and around its boxes in 16 frames."""
    scene = cornell()
    add_boxes(scene)
    scene.add("lamp", ceiling(-0.25, 0.25, -0.2, 0.2, 1.99), lamp(40))
    places = [(0.8 * math.sin(0.13 * k - 0.6), 1.1 + 0.02 * k, 2.9 - 0.13 * k) for k in range(16)]
    target = (0, 0.8, -0.4)
    scene.animate("camera", "translation", [(frame(k), place) for k, place in enumerate(places)])
    scene.animate("camera", "rotation", [(frame(k), rotation_towards(add(target, scaled(place, -1)), (0, 1, 0)))
                                         for k, place in enumerate(places)])
    return scene


BINARY = (cornell_point, cornell_area, cornell_glass, frosted_glass, tinted_glass, drink, cornell_mirror, ring, furnace, glossy,
          varnish, smooth_sphere, inside_glass, sky_room, spot, courtyard, veil, closed_room, sunlit_ground,
          forty_rooms, forty_bulbs, two_rooms, window_room, glazed_room, blind, glass_marble, marble_box, bulb, small_emitters,
          dark_room, gloss_only, shuffled_walls, textures, cutouts, moving_light, dynamic_shi, dynamic_slow_light,
          dynamic_switch, dynamic_block, dynamic_occluder, dynamic_water, dynamic_camera)
READABLE = (plane_point, closed_box)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    folder.mkdir(parents=True, exist_ok=True)
    for make in BINARY:
        (folder / (make.__name__ + ".glb")).write_bytes(make().glb())
    for make in READABLE:
        (folder / (make.__name__ + ".gltf")).write_bytes(make().gltf())


if __name__ == "__main__":
    main()
