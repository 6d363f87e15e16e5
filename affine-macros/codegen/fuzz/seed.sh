#!/usr/bin/env bash
# The specifications of the snapshots, one a file, as the corpus to start from.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
mkdir -p corpus/expand
for snapshot in ../../../tests/snapshots/*.snap; do
    args=$(sed -n 's/^description: "\(.*\)"$/\1/p' "$snapshot" | sed 's/\\"/"/g')
    item=$(sed -n '/^pub struct/,/[;}]$/{p;/[;}]$/q}' "$snapshot" | tr '\n' ' ')
    printf '%s\n%s' "$args" "$item" > "corpus/expand/$(basename "$snapshot" .snap)"
done
