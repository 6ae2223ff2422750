#!/usr/bin/env bash
# Tries this checkout on another Debian: makes a clean system of that release in a folder, once, and runs a command there in a
# clone of this checkout, as committed and changed (new files once `git add` knows them). Needs root and debootstrap.
#   share/on-debian.sh bookworm|trixie|sid [command ...]       default: bash share/demo.sh
#   share/on-debian.sh trixie bash tests/run.sh
# Systems stay in $CHROOTS (default: /var/tmp/lidar_upsampling), some 4 GB each, and with them what was built there: the next
# run builds what has changed. Packages come from where this machine's own come from, or from $DEBIAN_MIRROR.
set -euo pipefail
cd "$(dirname "$0")/.."
release=${1:-}
case $release in
  bookworm | trixie | sid) shift ;;
  *) echo "usage: $0 bookworm|trixie|sid [command ...]" >&2; exit 2 ;;
esac
[ $# -gt 0 ] || set -- bash share/demo.sh
root=$(realpath -m "${CHROOTS:-/var/tmp/lidar_upsampling}/$release")
checkout=/root/lidar_upsampling

fail() { echo "on-debian: $*" >&2; exit 1; }
[ "$(id -u)" = 0 ] || fail "only root may enter another system: sudo $0 $release"

make_system() {
  command -v debootstrap > /dev/null || fail "debootstrap is missing: apt-get install debootstrap"
  local mirror=${DEBIAN_MIRROR:-}
  [ -n "$mirror" ] || mirror=$(apt-get indextargets --format '$(REPO_URI)' \
    'Created-By: Packages' 'Label: Debian' 'Component: main' | head -n 1)
  [ -n "$mirror" ] || fail "this machine's apt knows no archive of Debian (after apt-get update); name one in DEBIAN_MIRROR"
  echo "Making a system of $release in $root ..." >&2
  rm -rf "$root.new"
  mkdir -p "$root.new"
  debootstrap --variant=minbase --include=ca-certificates,git "$release" "$root.new" "$mirror" > "$root.log" 2>&1 ||
    { tail -n 5 "$root.log" >&2; fail "debootstrap failed, see $root.log"; }
  # How this machine's apt gets through to the archive; not what it installs.
  apt-config dump | grep -E '^Acquire::(https?|Check-[A-Za-z-]+|Retries)\b' > "$root.new/etc/apt/apt.conf.d/90from-host" || true
  printf '#!/bin/sh\nexit 101\n' > "$root.new/usr/sbin/policy-rc.d" # packages start no services
  chmod +x "$root.new/usr/sbin/policy-rc.d"
  mv "$root.new" "$root"
}

clone_checkout() {
  local commit
  commit=$(git -c user.name=on-debian -c user.email=on-debian@localhost stash create)
  [ -d "$root$checkout" ] || git init --quiet "$root$checkout"
  git push --quiet --force "$root$checkout" "${commit:-HEAD}:refs/heads/tried"
  git -C "$root$checkout" checkout --quiet --force --detach tried
}

[ -d "$root" ] || make_system
clone_checkout
cp --dereference /etc/resolv.conf /etc/hosts "$root/etc/"
# Its mounts are seen by nobody else, and end with it.
status=0
unshare --mount --propagation private bash -euc '
  root=$1 checkout=$2
  shift 2
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  exec chroot "$root" env -i HOME=/root LANG=C.UTF-8 TERM="${TERM:-dumb}" PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    bash -c '\''cd "$0" && exec "$@"'\'' "$checkout" "$@"' inside "$root" "$checkout" "$@" || status=$?
echo "What it made is in $root$checkout" >&2
exit $status
