#!/usr/bin/env bash
# Prints how many compilers may run at once: as many as there are cores, with 1.7 GB of memory for each.
# CANOPEER_JOBS says another number.
set -euo pipefail
cores=$(nproc)
fit=$(awk '/^MemAvailable/ { print int($2 / 1700000) }' /proc/meminfo)
echo "${CANOPEER_JOBS:-$((fit < 1 ? 1 : fit < cores ? fit : cores))}"
