#!/usr/bin/env bash
# Shows that ./run and ./test do all the set-up on a fresh machine: makes a minimal Debian 12 in a folder,
# clones the committed project into it, and runs both there, twice, with nothing installed but git. Then installs
# the Debian package that was built there in a second one: tests/install_check.sh.
#
#     tests/fresh_machine.sh [FOLDER]       default: build/fresh; what an earlier call left there is removed
#
# Needs root, debootstrap, about 3 GB and half an hour. Packages come from where this machine's apt gets them.
# The film is left in FOLDER/out.
set -euo pipefail
export LC_ALL=C.UTF-8

project="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
. "$project/tests/minimal_debian.sh"
tree="$(realpath -m "${1:-$project/build/fresh}")"

echo "== minimal Debian 12 in $tree"
make_minimal_debian "$tree" git

echo "== clone of the committed project"
git clone --quiet --no-hardlinks "$project" "$tree/root/hibi"

# From the root folder: both commands must not depend on where they are called.
stamp() {
    inside "$tree" sh -c 'dpkg -l | sha256sum; find /root/hibi/build/release -name "*.o" -newer /stamp | wc -l'
}

echo "== ./run, without /proc"
time inside "$tree" /root/hibi/run

echo "== ./test, with /proc, which the browser of the film's test needs"
mount -t proc proc "$tree/proc"
trap 'umount "$tree/proc"' EXIT
time inside "$tree" /root/hibi/test

echo "== once more: nothing may be installed or compiled"
touch "$tree/stamp"
before="$(stamp)"
for command in "/root/hibi/run" "/root/hibi/test"; do
    time inside "$tree" "$command" >/dev/null
done
[ "$(stamp)" = "$before" ] || fail "the second call installed or compiled something"
[ -s "$tree/out/bending_fine/movie.mp4" ] || fail "the film is missing"
echo "== the Debian package, and a machine that has nothing else"
inside "$tree" sh -c 'cd /root/hibi && cpack --preset release' >>"$tree.log" 2>&1 || fail "cpack failed, see $tree.log"
"$project/tests/install_check.sh" "$tree"/root/hibi/build/release/hibi_*.deb "$tree-installed"
echo "== all as it should be; the film: $tree/out/bending_fine/movie.mp4"
