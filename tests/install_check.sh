#!/usr/bin/env bash
# Shows that the Debian package is all that a user needs: installs it in a minimal Debian 12 and makes a film there
# as an ordinary user.
#
#     tests/install_check.sh PACKAGE.deb [FOLDER]       default: build/installed; what an earlier call left is removed
#
# Needs root, debootstrap, about 1 GB and some minutes. The film is left in FOLDER/home/user/out.
set -euo pipefail
export LC_ALL=C.UTF-8

project="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
. "$project/tests/minimal_debian.sh"
package="${1:?the package: build/release/hibi_VERSION_ARCHITECTURE.deb, from cpack --preset release}"
tree="$(realpath -m "${2:-$project/build/installed}")"

echo "== minimal Debian 12 in $tree"
make_minimal_debian "$tree"
cp "$package" "$tree/tmp/hibi.deb"

echo "== the package, with what it depends on"
install() { inside "$tree" env DEBIAN_FRONTEND=noninteractive apt-get -y --no-install-recommends install "$@"; }
{ inside "$tree" apt-get update && install /tmp/hibi.deb && install man-db; } >>"$tree.log" 2>&1 ||
    fail "apt-get failed, see $tree.log"
mount -t proc proc "$tree/proc"
trap 'umount "$tree/proc"' EXIT
inside "$tree" useradd --create-home user
as_user() { inside "$tree" su - user -c "$1"; }

echo "== a film of the starter scene, by an ordinary user"
as_user 'hibi new my.toml && hibi run my.toml -q'
for file in movie.mp4 report.html strip.png; do
    [ -s "$tree/home/user/out/my/$file" ] || fail "$file is missing"
done
[ "$(head -n 1 "$tree/home/user/my.toml")" = "#:schema file:///usr/share/hibi/scene.schema.json" ] ||
    fail "the scene does not name its schema: $(head -n 1 "$tree/home/user/my.toml")"

echo "== manual and completion"
as_user 'man hibi' | grep -q 'turn one text file into a fracture film' || fail "man hibi shows something else"
as_user 'bash -c ". /usr/share/bash-completion/completions/hibi && complete -p hibi"' >/dev/null ||
    fail "no completion for bash"
echo "== all as it should be"
