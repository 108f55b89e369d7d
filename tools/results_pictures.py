"""Renders pictures, reads them, and measures the error of each layer against a pair of references."""

import hashlib
import itertools
import json
import struct
import subprocess
import zlib

DARK_SHARE = 0.01  # as in engine/image/metrics.cpp


def read_exr(path):
    """Layers by name ("" is the image), each a list of values r, g, b of each pixel. Reads ZIP and 32-bit floats only."""
    data = path.read_bytes()
    attributes, at = {}, 8
    while data[at]:
        name, kind, at = *data[at:].split(b"\0", 2)[:2], at
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    assert attributes[b"compression"] == b"\3"
    left, top, right, bottom = struct.unpack("<4i", attributes[b"dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels, rest = [], attributes[b"channels"]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        assert struct.unpack_from("<i", rest)[0] == 2
        channels.append(name.decode())
        rest = rest[16:]
    values = {name: [] for name in channels}
    for block in struct.unpack_from(f"<{(height + 15) // 16}q", data, at + 1):
        first, size = struct.unpack_from("<2i", data, block)
        rows = min(16, bottom + 1 - first)
        packed = data[block + 8:block + 8 + size]
        bytes_ = packed if size == 4 * width * rows * len(channels) else unpredicted(zlib.decompress(packed))
        row = struct.Struct(f"<{width}f")
        for i, name in enumerate(channels * rows):
            values[name] += row.unpack_from(bytes_, i * row.size)
    layers = {name.rpartition(".")[0] for name in channels}
    return {layer: list(itertools.chain.from_iterable(zip(*(values[f"{layer}.{c}".lstrip(".")] for c in "RGB"))))
            for layer in layers}


def unpredicted(data):
    """Undoes what OpenEXR does before it compresses: differences of successive bytes, after a split into even and odd ones."""
    sums = bytes(itertools.accumulate(data, lambda a, b: (a + b - 128) & 255))
    half = (len(sums) + 1) // 2
    result = bytearray(len(sums))
    result[::2], result[1::2] = sums[:half], sums[half:]
    return bytes(result)


def render(argand, scene, picture, *options):
    """Renders a picture. Returns the report."""
    report = picture.with_suffix(".json")
    command = [argand, "render", scene, "-q", "-o", picture, "--json", report, *options]
    subprocess.run([*map(str, command)], check=True)
    return json.loads(report.read_text())


def digest(*files):
    """A name for the contents of files."""
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:12]


# Light paths find the caustics or the many lamps of these scenes sooner than eye paths do. Where lights are points, eye paths
# also miss the light that caustics scatter on. See docs/results/bidirectional.md.
BY_LIGHT_PATHS = {"bulb", "classroom", "cornell_glass", "cornell_mirror", "glass_marble", "glazed_room", "gloss_only",
                  "inside_glass", "living_room", "living_room_2", "marble_box", "small_emitters"}


def reference_method(scene):
    """A method without bias, for the references of a scene."""
    return "bidirectional" if scene.stem in BY_LIGHT_PATHS else "path"


def reference_files(argand, scene, folder, size, samples, seeds, *options):
    """A picture by the reference method for each seed. They are kept in a folder until the scene changes."""
    method = reference_method(scene)
    pictures = [folder / f"{scene.stem}_{size}_{digest(scene)}_{method}_{samples}_{seed}.exr" for seed in seeds]
    for picture, seed in zip(pictures, seeds):
        if not picture.exists():
            picture.parent.mkdir(parents=True, exist_ok=True)
            render(argand, scene, picture, "--method", method, "--size", size, "--spp", samples, "--seed", seed, *options)
    return pictures


def references(argand, scene, folder, size, samples, seeds):
    """The layers of the reference pictures of a scene."""
    return [read_exr(picture) for picture in reference_files(argand, scene, folder, size, samples, seeds)]


def displayed(value):
    """A linear value as displays show it, 0 to 1."""
    return min(max(value, 0), 1) ** (1 / 2.2)


def write_png(path, width, pixels):
    """Writes a PNG of rows of `width` pixels, of three bytes each."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    row = 3 * width
    lines = b"".join(b"\0" + bytes(pixels[at:at + row]) for at in range(0, len(pixels), row))
    header = struct.pack(">IIBBBBB", width, len(pixels) // row, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 9)) +
                     chunk(b"IEND", b""))


def mean(values):
    return sum(values) / len(values)


def scales(first, second):
    """The squares by which relMSE divides. A black layer has none."""
    both = [(x + y) / 2 for x, y in zip(first, second)]
    dark = DARK_SHARE * mean(both) ** 2
    return [b * b + dark for b in both] if dark else None


def rel_mse(a, first, second):
    """relMSE of `a` against references whose independent noise cancels on average. None if they are black."""
    squares = scales(first, second)
    return squares and mean([(v - x) * (v - y) / s for v, x, y, s in zip(a, first, second, squares)])


def rel_variance(first, second):
    """relMSE of the mean of the references due to noise. None if they are black."""
    squares = scales(first, second)
    return squares and mean([(x - y) ** 2 / s for x, y, s in zip(first, second, squares)]) / 4
