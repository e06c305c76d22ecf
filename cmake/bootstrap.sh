# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced by tests/run and replay/demo: a fresh Debian 12 becomes one that can build this tree.

# install_missing PACKAGE...: says what it installs; silent, and without root, where nothing is missing.
install_missing() {
  local package missing=() as_root=()
  for package in "$@"; do
    if [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]]; then
      missing+=("$package")
    fi
  done
  ((${#missing[@]})) || return 0

  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "missing packages, and neither root nor sudo to install them: ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "installing ${missing[*]}" >&2
  "${as_root[@]}" apt-get -qq update >&2 || echo "apt-get update failed; trying with what is known" >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -y --no-install-recommends -o Dpkg::Use-Pty=0 install "${missing[@]}" >/dev/null
}

# What every native build needs; tests add googletest.
# shellcheck disable=SC2034
build_packages=(cmake ninja-build g++ libeigen3-dev libspdlog-dev libfmt-dev nlohmann-json3-dev
  libcli11-dev libpng-dev libyaml-cpp-dev libboost-dev libmosquitto-dev
  libdxflib-dev libpugixml-dev)
# What makes packages of it.
# shellcheck disable=SC2034
package_packages=(build-essential debhelper dh-python dpkg-dev fakeroot file gzip python3)
