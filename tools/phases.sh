# shellcheck shell=bash
# Sourced by tools/demo and tools/test: runs named phases from the root of the repository and says how long each took.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
this=tools/$(basename "$0")

# phase NAME COMMAND...: ends the script with the command's exit status if it fails.
phase() {
    local name=$1 start=$SECONDS status=0
    shift
    echo "== $this: $name: $*"
    "$@" </dev/null || status=$?
    if ((status != 0)); then
        echo "== $this: $name failed after $((SECONDS - start)) s" >&2
        exit "$status"
    fi
    echo "== $this: $name took $((SECONDS - start)) s"
}
