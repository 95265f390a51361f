#!/usr/bin/env bash
# Fills the folder that the browser tests run from: install.sh FOLDER. The checks (*.mjs) are copied into it, since
# node looks for packages from a script's own folder upwards; the packages of package.json are fetched where they
# do not lie there already, which takes the network.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
folder="${1:?the folder to fill}"

mkdir -p "$folder"
cp "$here"/*.mjs "$folder"
installed="$folder/installed.json" # the lock of what lies there; written last
if cmp -s "$here/package-lock.json" "$installed"; then exit 0; fi
if ! command -v npm >/dev/null; then
    echo "install.sh: npm is missing; ./test installs it, or: apt-get install nodejs npm" >&2
    exit 1
fi
rm -f "$installed"
cp "$here"/{package.json,package-lock.json,.npmrc} "$folder"
cd "$folder"
# A machine without a network is to be told within seconds.
if ! npm ci --ignore-scripts --loglevel=error --fetch-retries=1 --fetch-retry-mintimeout=1000; then
    echo "install.sh: npm could not fetch the packages of tests/web/package.json into $folder (reason above)." >&2
    echo "That takes the network, once; until then the tests of film, report and schema are not run." >&2
    exit 1
fi
cp package-lock.json "$installed"
