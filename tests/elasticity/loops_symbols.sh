#!/bin/bash
# An inline function that a level's object shares with the rest of the program could be the copy that the linker
# keeps, and would then need that level's processor everywhere. usage: loops_symbols.sh OBJECT...
set -euo pipefail
[ $# -gt 0 ]
for object in "$@"; do
    # Weak (V, W, u), or global other than the table of loops.
    shared=$(nm --demangle --defined-only "$object" | awk '$2 ~ /[A-TV-Z]|u|v|w/ && $0 !~ /::loops$/')
    [ -z "$shared" ] || { echo "$object shares with the rest of the program: $shared" >&2; exit 1; }
done
echo "$# objects share nothing"
