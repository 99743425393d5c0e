#!/usr/bin/env bash
# Runs a command on a copy of this tree in a small Debian of another release: scripts/in_debian.sh RELEASE COMMAND…
# e.g. scripts/in_debian.sh trixie ./demo.sh. For root, with debootstrap; the machine's own architecture.
# The Debian lies in build/debian/RELEASE (or where CANOPEER_DEBIAN_DIR says) and is kept, with the packages and the
# build in it: the tree's copy is /canopeer there, new at each call but for its build/ and out/.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "in_debian.sh: $*" >&2; exit 2; }
[ $# -ge 2 ] || fail "say a release and a command: scripts/in_debian.sh trixie ./demo.sh"
[ "$(id -u)" -eq 0 ] || fail "needs root, for chroot and mount."
[ -n "$(command -v debootstrap)" ] || fail "needs debootstrap: apt-get install debootstrap"
release=$1
shift
root=${CANOPEER_DEBIAN_DIR:-build/debian/$release}

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
  mv "$root.part" "$root"
fi

# The net as this machine has it.
apt-config dump Acquire | grep -E '^Acquire::(https?|Retries|Check-)' >"$root/etc/apt/apt.conf.d/90host" || true
cp -L /etc/resolv.conf "$root/etc/resolv.conf"
[ ! -f /etc/ssl/certs/ca-certificates.crt ] || cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"

tree=$root/canopeer
mkdir -p "$tree"
find "$tree" -mindepth 1 -maxdepth 1 ! -name build ! -name out -exec rm -rf {} +
git -c safe.directory='*' ls-files -z --cached --others --exclude-standard |
  tar -c --null --no-recursion --ignore-failed-read -T - | tar -x --no-same-owner -C "$tree"

# The mount ends with the namespace, however the command ends.
exec unshare --mount --propagation private bash -c '
  set -eu
  root=$1
  shift
  mount -t proc proc "$root/proc"
  mount -t devpts devpts "$root/dev/pts"
  exec chroot "$root" /usr/bin/env -i HOME=/root TERM=dumb LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    sh -c "cd /canopeer && exec \"\$@\"" sh "$@"' in_debian "$root" "$@"
