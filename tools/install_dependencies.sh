#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs what the library, its tools, tests, checks and demo need on Debian 12.
#   tools/install_dependencies.sh            as Debian 12 has it
#   tools/install_dependencies.sh --pdal     also what .ci/with_pdal builds PDAL with
# Run as root or as a user who may use sudo. Does nothing, quietly, if nothing is missing.
set -eu

build="cmake ninja-build g++ libpcl-dev libeigen3-dev"
tools="libboost-program-options-dev libembree-dev liblzf-dev libspdlog-dev libvtk9-dev libx11-dev nlohmann-json3-dev"
tests="chromium chromium-driver python3-pil python3-selenium dpkg-dev pkg-config libgtest-dev libbenchmark-dev libnanoflann-dev"
documentation="doxygen help2man man-db python3"
# ccache: .ci/run builds most files for more than one configuration.
checks="ccache clang-format clang-tidy git ca-certificates"
# VTK draws through an X server; xvfb-run needs xauth, and a machine without a GPU needs Mesa's software renderer.
demo="xvfb xauth libgl1-mesa-dri jq"
pdal=""

case "${1-}" in
  "") ;;
  --pdal) pdal="libcurl4-openssl-dev libgdal-dev libgeotiff-dev libxerces-c-dev libxml2-dev libzstd-dev" ;;
  *)
    echo "install_dependencies.sh: unknown option '$1'; usage: tools/install_dependencies.sh [--pdal]" >&2
    exit 2
    ;;
esac

fail()
{
  echo "install_dependencies.sh: $1" >&2
  exit 1
}

command -v apt-get >/dev/null ||
  fail "apt-get not found; this script knows Debian 12 only. Install by hand what README.md lists."

missing=""
for package in $build $tools $tests $documentation $checks $demo $pdal; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
# Not asked of dpkg: upstream's Node.js packages bring npm along and conflict with Debian's own.
command -v npm >/dev/null || missing="$missing npm"
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail "missing:$missing. Run this script as root, or install sudo."
  as_root="sudo"
fi

apt_get()
{
  # The timeout waits for another apt that is at work, such as a machine's first unattended upgrade.
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get --quiet=2 -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 \
    "$@" </dev/null >"$log" 2>&1
}
log=$(mktemp)
trap 'rm -f "$log"' EXIT

echo "Installing:$missing"
apt_get update || { cat "$log" >&2; fail "apt-get update failed; see above. Is the network reachable?"; }
# shellcheck disable=SC2086  # a list of words
apt_get install --yes --no-install-recommends $missing ||
  { cat "$log" >&2; fail "apt-get could not install:$missing; see above."; }
