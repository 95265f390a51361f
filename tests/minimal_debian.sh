# What fresh_machine.sh and install_check.sh share, for bash: a minimal Debian 12 in a folder of its own.
# Needs root and debootstrap. Packages come from where this machine's apt gets them.

fail() {
    echo "${0##*/}: $*" >&2
    exit 1
}

# Makes one in the folder given, with the packages given; what an earlier call left there is removed.
make_minimal_debian() {
    local tree="$1" mirror
    [ "$(id -u)" -eq 0 ] || fail "needs root, for debootstrap and chroot"
    command -v debootstrap >/dev/null || fail "debootstrap is missing; apt-get install debootstrap"
    mirror="$(apt-get indextargets --format '$(REPO_URI)' 'Identifier: Packages' 'Codename: bookworm' \
        'Origin: Debian' 'Component: main' | head -n 1)"
    [ -n "$mirror" ] || fail "the apt of this machine knows no source of Debian 12 (bookworm)"
    local marker="$tree/etc/hibi-fresh-machine"
    if [ -e "$tree" ]; then
        # Only what an earlier call made: the folder may be mistyped.
        [ -e "$marker" ] || fail "$tree exists and is not mine"
        rm -rf --one-file-system "$tree"
    fi
    mkdir -p "$tree/etc"
    touch "$marker"
    debootstrap --variant=minbase ${2:+--include="$2"} bookworm "$tree" "$mirror" >"$tree.log" 2>&1 ||
        fail "debootstrap failed, see $tree.log"
    cp /etc/resolv.conf "$tree/etc/resolv.conf"
    echo '127.0.0.1 localhost' >"$tree/etc/hosts" # what an installed machine has, and debootstrap leaves out
    # The way out of this machine, where there is a proxy, and the certificates that it shows there.
    apt-config dump | grep -i '::proxy' >"$tree/etc/apt/apt.conf.d/proxy" || true
    mkdir -p "$tree/usr/local/share/ca-certificates"
    cp /usr/local/share/ca-certificates/*.crt "$tree/usr/local/share/ca-certificates" 2>/dev/null || true
}

# Runs a command in the tree, from its root folder and with an environment of its own.
inside() {
    local tree="$1"
    shift
    env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin ${http_proxy:+http_proxy="$http_proxy"} \
        ${https_proxy:+https_proxy="$https_proxy"} chroot "$tree" "$@"
}
