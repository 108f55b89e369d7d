#!/usr/bin/env python3
"""Writes the scenes of this folder to it, or to the folder given. The bytes are always the same.

    python3 assets/make_scenes.py [FOLDER]

Lengths are in metres, y is up. Intensities are such that exposure 0 shows the pictures well.
"""

import math
import pathlib
import sys

from gltf_writer import (Mesh, Scene, blended, box, emitter, glass, lambertian, metal, phong, quad, revolved, sphere)

WHITE, RED, GREEN = (0.725, 0.71, 0.68), (0.63, 0.065, 0.05), (0.14, 0.45, 0.091)
SUNK = 0.01  # bodies reach this far into the floor, so that they are closed without a face in its plane


def ceiling(x0, x1, z0, z1, y=2):
    return quad((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))


def cornell(light=False):
    """The empty Cornell box (after Goral et al.), 2 × 2 × 2, open towards the camera in front of it, with or without a
    light set flush into the ceiling."""
    scene = Scene()
    l, r, b, t, n, f = -1, 1, 0, 2, 1, -1
    scene.add("floor", quad((l, b, n), (r, b, n), (r, b, f), (l, b, f)), lambertian(WHITE))
    if light:
        x, z, strength = 0.25, 0.2, 22
        scene.add("ceiling, back", ceiling(l, r, f, -z), lambertian(WHITE))
        scene.add("ceiling, front", ceiling(l, r, z, n), lambertian(WHITE))
        scene.add("ceiling, left", ceiling(l, -x, -z, z), lambertian(WHITE))
        scene.add("ceiling, right", ceiling(x, r, -z, z), lambertian(WHITE))
        scene.add("light", ceiling(-x, x, -z, z), emitter((strength, 0.86 * strength, 0.68 * strength)))
    else:
        scene.add("ceiling", ceiling(l, r, f, n), lambertian(WHITE))
    scene.add("back wall", quad((l, b, f), (r, b, f), (r, t, f), (l, t, f)), lambertian(WHITE))
    scene.add("left wall", quad((l, b, n), (l, b, f), (l, t, f), (l, t, n)), lambertian(RED))
    scene.add("right wall", quad((r, b, f), (r, b, n), (r, t, n), (r, t, f)), lambertian(GREEN))
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


def cornell_mirror():
    scene = cornell(light=True)
    # Turned so that the camera sees the room in it, not the darkness in front of the box.
    scene.add("mirror", tall_box(40), metal((0.95, 0.95, 0.95), 0))
    scene.add("short box", short_box(), lambertian(WHITE))
    return scene


def ring():
    """The cardioid caustic of a metal ring (after the Ring of Fabianowski and Dingliana 2009)."""
    inner, outer, low, high, bevel, steps = 1.0, 1.08, -SUNK, 0.45, 0.025, 4
    profile = []
    for start, r, h in ((0, outer - bevel, high - bevel), (90, inner + bevel, high - bevel),
                        (180, inner + bevel, low + bevel), (270, outer - bevel, low + bevel)):
        for step in range(steps + 1):
            a = math.radians(start + 90 * step / steps)
            profile.append((r + bevel * math.cos(a), h + bevel * math.sin(a), math.cos(a), math.sin(a)))
    scene = Scene()
    scene.add("plane", quad((-4, 0, 4), (4, 0, 4), (4, 0, -4), (-4, 0, -4)), lambertian((0.8, 0.8, 0.8)))
    scene.add("ring", revolved(profile, 96), metal((0.95, 0.79, 0.45), 0))
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
    """A file without lights gets the uniform sky: an albedo of 1 is invisible against it, exactly so with flat facets."""
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
    """A file without lights gets the uniform sky, which comes in through the open front."""
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


BINARY = (cornell_point, cornell_area, cornell_glass, cornell_mirror, ring, furnace, glossy, smooth_sphere,
          inside_glass, sky_room, spot, courtyard, veil)
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
