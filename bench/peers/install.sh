#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs the tools that run.py compares with, on Debian 12. Run as root. They are heavy, and only this comparison needs
# them: tools/install_dependencies.sh installs the rest.
set -eu
DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends \
  libcgal-dev libtbb-dev python3 python3-matplotlib python3-open3d python3-numpy meshlab xvfb xauth
