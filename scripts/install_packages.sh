#!/usr/bin/env bash
# Installs what packages.txt lists and this machine lacks (Debian, Ubuntu). Quick and silent when nothing is missing.
# In packages.txt `a|b` is the first of the two that the release has, `a?` is installed when the release has it, and `a!c?` when
# there is no command c either.
# With the word demo only those above the line "Beyond the demo".
# DEB_HOST_ARCH=arm64 asks for what another machine needs to compile for that one: its libraries, a compiler, an emulator.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

last='$'
[ "${1:-}" != demo ] || last='/^# -* Beyond the demo/'
mapfile -t wanted < <(sed -n "1,${last}p" "$root/packages.txt" | sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d')
if [ "${DEB_HOST_ARCH:-}" = arm64 ]; then
  # Libraries of that machine's, or those for all; tools as they are.
  mapfile -t wanted < <(printf '%s\n' "${wanted[@]}" | sed -E 's/(^|\|)((lib|zlib|coinor-lib)[^|?]*)/\1\2:arm64|\2/g')
  wanted+=(g++-aarch64-linux-gnu qemu-user)
fi
for i in "${!wanted[@]}"; do
  [[ ${wanted[i]} == *\!* ]] || continue
  command=${wanted[i]#*!}
  if command -v "${command%\?}" >/dev/null; then unset "wanted[i]"; else wanted[i]=${wanted[i]%%!*}?; fi
done
mapfile -t names < <(printf '%s\n' "${wanted[@]}" | tr -d '?' | tr '|' '\n')
installed=$(dpkg-query -W -f '${Package}:${Architecture} ${Status}\n' "${names[@]}" 2>/dev/null | sed -n 's/ install ok installed$//p' || true)
if [ "${DEB_HOST_ARCH:-}" = arm64 ]; then
  # A library of this machine's is none of that one's.
  installed=$(sed -E '/^(lib|zlib|coinor-lib).*:/{/:(arm64|all)$/!d}; /:arm64$/!s/:.*//' <<<"$installed")
else
  installed=$(sed 's/:.*//' <<<"$installed")
fi
required=()
optional=()
for entry in "${wanted[@]}"; do
  # An installed one of several is enough.
  pattern="^(${entry%\?})\$"
  grep -qE "${pattern//+/\\+}" <<<"$installed" && continue
  if [[ $entry == *\? ]]; then optional+=("${entry%\?}"); else required+=("$entry"); fi
done
[ $((${#required[@]} + ${#optional[@]})) -eq 0 ] && exit 0

sudo=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    [ ${#required[@]} -eq 0 ] && exit 0
    echo "Missing packages: ${required[*]}. Not root and no sudo: install them, then run again." >&2
    exit 1
  fi
  sudo=(sudo)
fi

# Prints the first of a|b|… that the release has; fails when it has none, or when its lists were never fetched.
available() {
  local name
  for name in ${1//|/ }; do
    [ -z "$(LC_ALL=C apt-cache policy "$name" 2>/dev/null | sed -n '/^  Candidate: [^(]/p')" ] || { echo "$name"; return; }
  done
  return 1
}

# Only what must be there is worth fetching the lists for: a release may lack the rest for good.
[ ${#required[@]} -eq 0 ] || "${sudo[@]}" apt-get update -qq
install=()
for entry in "${required[@]}"; do
  name=$(available "$entry") || { echo "This release has no package $entry (packages.txt)." >&2; exit 1; }
  install+=("$name")
done
for entry in "${optional[@]}"; do
  if name=$(available "$entry"); then install+=("$name"); fi
done
[ ${#install[@]} -eq 0 ] && exit 0
echo "Installing ${#install[@]} packages: ${install[*]}"
get=("${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${install[@]}")
if [ ${#required[@]} -eq 0 ]; then
  "${get[@]}" >/dev/null || echo "Could not install them: the tests that need them are left out." >&2
else
  "${get[@]}" >/dev/null
fi
