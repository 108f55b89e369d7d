"""Shared by the scripts that measure docs/results."""

import datetime
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
ARGAND = ROOT / "build/release/tools/argand/argand"


def revision_of(folder):
    """The revision of the working tree that a folder belongs to."""
    found = subprocess.run(["git", "-C", folder, "rev-parse", "--short", "HEAD"], capture_output=True, text=True)
    return found.stdout.strip() or "unknown"


def given(parser, options, *names):
    """The words of those of these options that have not their default values, as they stand on the command line."""
    return [f"--{name.replace('_', '-')} {getattr(options, name)}" for name in names
            if getattr(options, name) != parser.get_default(name)]


def origin():
    """A sentence: the command, date, revision and machine of the results."""
    command = " ".join([pathlib.Path(sys.argv[0]).name, *sys.argv[1:]])
    return (f"Written by `tools/{command}`. {datetime.date.today()}, revision {revision_of(ROOT)}, "
            f"{platform.machine()}, {os.cpu_count()} cores.")


def wrap(paragraph):
    """Lines of at most 120 characters; those of an item of a list, which begins with a dash, are indented."""
    indent = "  " if paragraph.startswith("- ") else ""
    return textwrap.wrap(paragraph, 120, break_on_hyphens=False, subsequent_indent=indent)


def stage_seconds(name):
    """A function of the JSON report of a render: the device's seconds in the stage of this name."""
    return lambda report: sum(stage["gpu_seconds"] for stage in report["stages"] if stage["name"] == name)


def run_timed(*command):
    """Runs a command. Returns its exit status, what it wrote to stderr, and the processor's seconds."""
    with tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen([*map(str, command)], stdout=subprocess.DEVNULL, stderr=errors)
        _, status, usage = os.wait4(process.pid, 0)
        errors.seek(0)
        return status, errors.read(), usage.ru_utime + usage.ru_stime


def render_reports(scene, folder, settings, *arguments):
    """Runs `argand render`. Returns its JSON reports: one by --at, else one for each frame."""
    log = folder / "log.jsonl"
    subprocess.run([str(ARGAND), "render", str(scene), "-q", *settings, "--json", str(log), *map(str, arguments)],
                   check=True)
    text = log.read_text()
    return [json.loads(text)] if "--at" in arguments else [json.loads(line) for line in text.splitlines()]


def replace_section(page, heading, text):
    """Puts a section of a page, which begins with its heading, in the place of the one before, or at the end."""
    before, found, behind = page.read_text().partition(heading + "\n")
    rest = behind[behind.index("\n## ") + 1:] if found and "\n## " in behind else ""
    page.write_text(before.rstrip() + "\n\n" + text.rstrip() + "\n" + ("\n" + rest if rest else ""))


# The pages of docs/results: figure, page, command.
PAGES = [
    ("Speed of the parts", "parts.md", "tools/results"),
    ("Error at default settings", "errors.md", "tools/results"),
    ("Time from start to picture", "start.md", "tools/results"),
    ("Errors and times on request", "targets.md", "tools/results_targets"),
    ("Errors as told and as they are", "reached.md", "tools/results_targets --targets"),
    ("Error at equal time", "budgets.md", "a script outside the repository"),
    ("Fabianowski and Dingliana 2009", "fd09.md", "argand bench --paper fd09"),
    ("Keller et al. 2010: simultaneous queries", "kdgs10.md", "argand bench --paper kdgs10"),
    ("Yao et al. 2010: photons through cube maps", "ywcyp10.md", "tools/results_image_space"),
    ("Shi 2012: a photons queue", "shi12.md", "argand bench --paper shi12"),
    ("Bandwidth", "bandwidth.md", "a script outside the repository"),
    ("Footprints: choices", "footprints.md", "argand render, argand compare"),
    ("Widths that fall from pass to pass", "progressive.md", "tools/results_progressive"),
    ("Error over time", "over_time.md", "tools/results_over_time"),
    ("Eye paths and light paths", "bidirectional.md", "tools/results_bidirectional"),
    ("Final gather", "final_gather.md", "argand render, argand compare"),
    ("Quasi-random photons", "quasi_random.md", "argand render, argand compare"),
    ("Smaller records, faster arithmetic", "precision.md", "argand render, changed builds"),
    ("Numerical stability", "numerics.md", "tools/results_numerics"),
    ("Specialisation to the scene", "specialisation.md", "tools/results_specialisation"),
    ("Backends: summary", "backends.md", "tools/results_backends"),
    ("On a GPU: an H200", "h200.md", "argand bench, argand render --frames, argand compare-backends"),
    ("Backends: lavapipe and the host", "backends_vulkan_cpu.md", "tools/results_backends vulkan cpu"),
    ("Path tracer compared with Cycles", "cycles.md", "argand render, Blender"),
    ("Scenes unlike a box of two metres", "hard_scenes.md", "tools/results_hard_scenes"),
    ("Films: time and error by frame", "dynamic.md", "tools/results_dynamic, tools/results_queue"),
    ("Frames of films", "frames.md", "argand render --frames, argand bench rays, tools/results_frames, tools/results_refit"),
    ("Previews of a view", "view.md", "tools/results_view"),
    ("Sample models of glTF", "gltf.md", "tools/results_gltf"),
    ("Loading textured scenes, and what textures cost", "loading.md", "tools/results_loading"),
    ("What was wrong outside the Cornell box", "rooms.md",
     "tools/results_rooms, tools/results_means, tools/results_coverage, argand render, test_methods"),
    ("The source tree, before and after a rework", "tree.md", "tools/lint, tools/test"),
]


def revisions(text):
    """The revisions that a page says it measured, or those before and after a change."""
    return list(dict.fromkeys(re.findall(r"revisions?\s+([0-9a-f]{7,12})\b", text))) or ["not recorded"]


def write_index():
    """Writes docs/results/README.md: a line for each page, with the revisions that the page names."""
    folder = ROOT / "docs/results"
    lines = ["# Measured results", "",
             "`write_index()` in `tools/results_common.py` writes this index. `tradeoff_*.csv` are the tables of sweeps by "
             "`tools/results_targets` ([tradeoff.md](../tradeoff.md) says how to read them).", "",
             "| figure | command | revision |", "| --- | --- | --- |"]
    for figure, page, command in PAGES:
        if (folder / page).exists():
            of = ", ".join(revisions((folder / page).read_text()))
            how = command if command.startswith("a ") else f"`{command}`"
            lines.append(f"| [{figure}]({page}) | {how} | {of} |")
    (folder / "README.md").write_text("\n".join([*lines, ""]))
