"""What the scripts that measure docs/results share."""

import datetime
import os
import pathlib
import platform
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
ARGAND = ROOT / "build/release/tools/argand/argand"


def origin():
    """By what, when, of what and where results were made."""
    command = " ".join([pathlib.Path(sys.argv[0]).name, *sys.argv[1:]])
    revision = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True)
    return (f"Written by `tools/{command}`. {datetime.date.today()}, revision {revision.stdout.strip()}, "
            f"{platform.machine()}, {os.cpu_count()} cores.")
