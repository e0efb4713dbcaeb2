#!/usr/bin/env bash
# Types README.md's commands on a fresh Debian 12, made by debootstrap in a folder: the demo, all tests, install, the
# tutorial with what was installed, uninstall; then compares the machine's files with those before the installation.
#
# Needs root and debootstrap. FRESH is the folder (it is removed first and afterwards), MIRROR a Debian mirror
# (default: the one that this Debian uses), SUITE its release, CHECK=no leaves the tests out.
set -eu
cd "$(dirname "$0")/.."
fresh=$(realpath -m "${FRESH:-build/fresh}")
suite=${SUITE:-bookworm}
mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' |
    awk -v suite="$suite" '$2 == suite { print $1; exit }')}
[ "$(id -u)" = 0 ] || { echo "fresh_machine.sh: needs root, for debootstrap and chroot" >&2; exit 2; }

# What is mounted in the folder is gone with the namespace.
if [ "${1:-}" != inside ]; then
    rm -rf --one-file-system "$fresh"
    trap 'rm -rf --one-file-system "$fresh"' EXIT
    debootstrap --variant=minbase "$suite" "$fresh" "$mirror" > "$fresh.log" 2>&1 || { tail "$fresh.log"; exit 1; }
    rm "$fresh.log"
    cp /etc/resolv.conf "$fresh/etc/"
    # Where a proxy stands before the package index, pip is told its certificate.
    cp "${PIP_CERT:-/dev/null}" "$fresh/root/pip.crt"
    mkdir "$fresh/root/povgloss"
    git archive HEAD | tar -x -C "$fresh/root/povgloss"
    FRESH=$fresh CHECK=${CHECK:-yes} unshare --mount --pid --fork --kill-child "$0" inside
    exit
fi

mount -t proc proc "$fresh/proc"
mount --rbind /dev "$fresh/dev"
mount -t tmpfs tmpfs "$fresh/tmp"
env -i HOME=/root PATH=/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin CHECK="$CHECK" JOBS="${JOBS:-}" \
    ${PIP_CERT:+PIP_CERT=/root/pip.crt} \
    chroot "$fresh" bash -eu <<'TYPED'
cd /root/povgloss
files() { find / -xdev ! -path '/root/povgloss/*' ! -path '/tmp/*' ! -path '/var/cache/*' -printf '%p %y\n' | sort; }

apt-get update -qq && apt-get install -y -qq --no-install-recommends make > /dev/null 2>&1
make deps demo
[ "$CHECK" = no ] || make deps check ${JOBS:+JOBS=$JOBS}
files > /tmp/before
make install
mkdir /tmp/tutorial
BIN=/usr/local/bin tests/e2e/tutorial.sh
make uninstall
files > /tmp/after
diff /tmp/before /tmp/after && echo "install and uninstall left no trace"
TYPED
