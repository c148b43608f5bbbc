# SPDX-License-Identifier: GPL-2.0-or-later
# The Debian packages that capfrac and a YADE built from source need.
# Sourced, never run.

# To build and test capfrac itself.
CAPFRAC_PACKAGES=(
	bash bzip2 ca-certificates cmake g++ git ninja-build xz-utils
	libboost-all-dev libcgal-dev libeigen3-dev libgmp-dev libgtest-dev libmpfr-dev libsuitesparse-dev
	python3 python3-dev python3-matplotlib python3-meshio python3-numpy python3-scipy
	python3-distributed python3-pytest python3-tqdm
)

# What YADE's own configuration insists on, even for a minimal build.
YADE_BUILD_PACKAGES=(
	libbz2-dev libmpc-dev libopenblas-dev libsqlite3-dev zlib1g-dev
	python3-future python3-ipython python3-minieigen python3-mpi4py python3-mpmath python3-pil
	python3-pygraphviz python3-pyqt5 python3-sphinx python3-tk python3-xlib
)

# The distribution's YADE, and what its headers include (it is built with MPI, OpenGL and MPC).
YADE_PACKAGES=(yade freeglut3-dev libglu1-mesa-dev libmpc-dev libopenmpi-dev)

missing_packages() {
	local package
	for package in "$@"; do
		dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || printf '%s\n' "$package"
	done
}

# require_packages NAME...: installs what is missing where it may, else says
# exactly what is missing and how to get it.
require_packages() {
	local missing runner=()
	command -v dpkg-query >/dev/null || die "this script needs a Debian-like system (dpkg-query was not found)"
	mapfile -t missing < <(missing_packages "$@")
	((${#missing[@]} == 0)) && return 0
	if ((EUID != 0)); then
		if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
			runner=(sudo -n env DEBIAN_FRONTEND=noninteractive)
		else
			die "these Debian packages are missing and only root may install them: ${missing[*]}
  ask an administrator to run:  apt-get install --no-install-recommends ${missing[*]}
  then run this script again."
		fi
	else
		runner=(env DEBIAN_FRONTEND=noninteractive)
	fi
	say "installing ${#missing[@]} Debian packages: ${missing[*]}"
	"${runner[@]}" apt-get update -qq || warn "the package lists could not be refreshed; going on with those at hand"
	"${runner[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >"$CAPFRAC_CACHE/apt.log" 2>&1 \
		|| { tail -n 20 "$CAPFRAC_CACHE/apt.log" >&2; die "the package manager could not install: ${missing[*]}"; }
}
