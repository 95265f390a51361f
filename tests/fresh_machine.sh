#!/usr/bin/env bash
# Shows that ./run and ./test do all the set-up on a fresh machine: makes a minimal Debian 12 in a folder,
# clones the committed project into it, and runs both there, twice, with nothing installed but git.
#
#     tests/fresh_machine.sh [FOLDER]       default: build/fresh; what an earlier call left there is removed
#
# Needs root, debootstrap, about 3 GB and half an hour. Packages come from where this machine's apt gets them.
# The film is left in FOLDER/out.
set -euo pipefail
export LC_ALL=C.UTF-8

project="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
tree="$(realpath -m "${1:-$project/build/fresh}")"
marker="$tree/etc/hibi-fresh-machine"

fail() {
    echo "fresh_machine.sh: $*" >&2
    exit 1
}
[ "$(id -u)" -eq 0 ] || fail "needs root, for debootstrap and chroot"
command -v debootstrap >/dev/null || fail "debootstrap is missing; apt-get install debootstrap"
mirror="$(apt-get indextargets --format '$(REPO_URI)' 'Identifier: Packages' 'Codename: bookworm' \
    'Origin: Debian' 'Component: main' | head -n 1)"
[ -n "$mirror" ] || fail "the apt of this machine knows no source of Debian 12 (bookworm)"

if [ -e "$tree" ]; then
    # Only what an earlier call made: FOLDER may be mistyped.
    [ -e "$marker" ] || fail "$tree exists and is not mine"
    rm -rf --one-file-system "$tree"
fi

echo "== minimal Debian 12 in $tree"
mkdir -p "$tree/etc"
touch "$marker"
debootstrap --variant=minbase --include=git bookworm "$tree" "$mirror" >"$tree.log" 2>&1 ||
    fail "debootstrap failed, see $tree.log"
cp /etc/resolv.conf "$tree/etc/resolv.conf"
echo '127.0.0.1 localhost' >"$tree/etc/hosts" # what an installed machine has, and debootstrap leaves out
# The way out of this machine, where there is a proxy.
apt-config dump | grep -i '::proxy' >"$tree/etc/apt/apt.conf.d/proxy" || true

echo "== clone of the committed project"
git clone --quiet --no-hardlinks "$project" "$tree/root/hibi"

# In the tree from the root folder: both commands must not depend on where they are called.
inside() { env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$tree" "$@"; }
stamp() {
    inside sh -c 'dpkg -l | sha256sum; find /root/hibi/build/release -name "*.o" -newer /stamp | wc -l'
}

echo "== ./run, without /proc"
time inside /root/hibi/run

echo "== ./test, with /proc, which the browser of the film's test needs"
mount -t proc proc "$tree/proc"
trap 'umount "$tree/proc"' EXIT
time inside /root/hibi/test

echo "== once more: nothing may be installed or compiled"
touch "$tree/stamp"
before="$(stamp)"
for command in "/root/hibi/run" "/root/hibi/test"; do
    time inside "$command" >/dev/null
done
[ "$(stamp)" = "$before" ] || fail "the second call installed or compiled something"
[ -s "$tree/out/bending_fine/movie.mp4" ] || fail "the film is missing"
echo "== all as it should be; the film: $tree/out/bending_fine/movie.mp4"
