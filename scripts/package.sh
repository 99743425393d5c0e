#!/usr/bin/env bash
# Makes the Debian packages canopeer and libcanopeer-dev of this tree, for the Debian it runs on, in build/packages.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh
for tool in dpkg-shlibdeps:dpkg-dev file:file; do
  [ -n "$(command -v "${tool%:*}")" ] || missing="${missing:-} ${tool#*:}"
done
if [ -n "${missing:-}" ]; then
  [ "$(id -u)" -eq 0 ] || { echo "Missing packages:$missing. Install them, then run again." >&2; exit 1; }
  # shellcheck disable=SC2086
  apt-get install -y -qq --no-install-recommends $missing >/dev/null
fi

# The date of the last change, so that one tree gives one package.
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || stat -c %Y CHANGELOG.md)}
export SOURCE_DATE_EPOCH
cmake -S . -B build/package -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr \
  -DCANOPEER_BUILD_TESTS=OFF -DCANOPEER_UNITY_BUILD=ON -DCANOPEER_PACKAGES=ON >/dev/null
cmake --build build/package -j "$(scripts/jobs.sh)"
rm -rf build/packages
(cd build/package && cpack -G DEB -B "$PWD/../packages" >cpack.log 2>&1) || { cat build/package/cpack.log >&2; exit 1; }
rm -rf build/packages/_CPack_Packages
ls -l build/packages
