#!/usr/bin/env bash
# Writes the API pages of the installed headers to build/api/html, with Doxygen. Any warning is an error, also a class
# without a sentence. Members may go without one: their names say what they are.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ -z "$(command -v doxygen)" ]; then
  echo "api_docs.sh: needs doxygen (some 25 MB): apt-get install --no-install-recommends doxygen" >&2
  exit 2
fi
rm -rf build/api
cmake -DTO=build/api/include -P cmake/InstalledHeaders.cmake
# First what is not said, then the pages: they show also what needs no sentence.
printf '%s\n' '@INCLUDE = docs/api/Doxyfile' EXTRACT_ALL=NO WARN_IF_UNDOCUMENTED=YES | doxygen -
# Messages of ROS are documented there.
if grep -v -E 'Member .* is not documented|cdr/messages/.* is not documented|^$' build/api/warnings.txt >&2; then exit 1; fi
doxygen docs/api/Doxyfile
if [ -s build/api/warnings.txt ]; then cat build/api/warnings.txt >&2; exit 1; fi
echo "build/api/html/index.html"
