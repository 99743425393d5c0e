#!/usr/bin/env bash
# Runs a command on a copy of this tree in a small Debian of its own: scripts/in_debian.sh RELEASE [ARCH] COMMAND…
#   scripts/in_debian.sh trixie ./demo.sh            # Debian 13, the machine's own architecture
#   scripts/in_debian.sh bookworm arm64 ./demo.sh    # Debian 12 on arm64, on an amd64 machine
# For root, with debootstrap. The other architecture is cross-compiled: tools are the machine's, libraries the other's, and
# programs run under qemu-user, which is named wherever one is started; the kernel needs to know nothing of it.
# The Debian lies in build/debian/RELEASE-ARCH (or where CANOPEER_DEBIAN_DIR says) and is kept, with the packages and the
# build in it: the tree's copy is /canopeer there, new at each call but for its build/ and out/. It shares this machine's
# compiler cache.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "in_debian.sh: $*" >&2; exit 2; }
[ $# -ge 2 ] || fail "say a release and a command: scripts/in_debian.sh trixie ./demo.sh"
[ "$(id -u)" -eq 0 ] || fail "needs root, for chroot and mount."
[ -n "$(command -v debootstrap)" ] || fail "needs debootstrap: apt-get install debootstrap"
release=$1
shift
machine=$(dpkg --print-architecture)
arch=$machine
case $1 in amd64 | arm64) arch=$1; shift ;; esac
[ $# -ge 1 ] || fail "say a command, too: scripts/in_debian.sh $release $arch ./demo.sh"
settings=()
if [ "$arch" != "$machine" ]; then
  [ "$machine-$arch" = amd64-arm64 ] || fail "on $machine there is no way to $arch, only from amd64 to arm64."
  # What scripts/install_packages.sh, CMake and demo.sh go by.
  settings=(DEB_HOST_ARCH=arm64 CMAKE_TOOLCHAIN_FILE=/canopeer/cmake/arm64.cmake CANOPEER_EMULATOR=qemu-aarch64)
fi
root=${CANOPEER_DEBIAN_DIR:-build/debian/$release-$arch}

mkdir -p "$(dirname "$root")"
exec 9>"$root.lock"
flock -n 9 || fail "another command runs in $root"

if [ ! -d "$root" ]; then
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | head -n 1)
  [ -n "$mirror" ] || fail "apt knows no mirror of Debian here (apt-get update?)"
  eval "$(apt-config shell http_proxy Acquire::http::Proxy)"
  [ -z "${http_proxy:-}" ] || export http_proxy
  rm -rf "$root.part"
  mkdir -p "$root.part"
  echo "Making $root from $mirror: some minutes"
  debootstrap --variant=minbase --include=ca-certificates "$release" "$root.part" "$mirror" >"$root.log" 2>&1 ||
    fail "debootstrap failed, see $root.log"
  [ "$arch" = "$machine" ] || chroot "$root.part" dpkg --add-architecture "$arch"
  mv "$root.part" "$root"
fi

# The net as this machine has it.
apt-config dump Acquire | grep -E '^Acquire::(https?|Retries|Check-)' >"$root/etc/apt/apt.conf.d/90host" || true
cp -L /etc/resolv.conf "$root/etc/resolv.conf"
[ ! -f /etc/ssl/certs/ca-certificates.crt ] || cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"

# What is as it was keeps its time. What has changed is as new as the copy: it may have changed while the last one was compiled.
tree=$root/canopeer
copy=$root/canopeer.copy
rm -rf "$copy"
mkdir -p "$tree" "$copy" "$root/root/.cache/ccache"
git -c safe.directory='*' ls-files -z --cached --others --exclude-standard |
  tar -c --null --no-recursion --ignore-failed-read -T - | tar -x -m --no-same-owner -C "$copy"
(cd "$copy" && find . -type f -print0) | while IFS= read -r -d '' file; do
  ! cmp -s "$copy/$file" "$tree/$file" || touch -r "$tree/$file" "$copy/$file"
done
find "$tree" -mindepth 1 -maxdepth 1 ! -name build ! -name out -exec rm -rf {} +
cp -a "$copy/." "$tree/"
rm -rf "$copy"
cache=$(ccache --get-config cache_dir 2>/dev/null || true)

# The mounts end with the namespace, however the command ends.
exec unshare --mount --propagation private bash -c '
  set -eu
  root=$1 cache=$2
  shift 2
  mount -t proc proc "$root/proc"
  mount -t devpts devpts "$root/dev/pts"
  [ ! -d "$cache" ] || mount --bind "$cache" "$root/root/.cache/ccache"
  exec chroot "$root" /usr/bin/env -i HOME=/root TERM=dumb LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"' \
  in_debian "$root" "$cache" "${settings[@]}" sh -c 'cd /canopeer && exec "$@"' sh "$@"
