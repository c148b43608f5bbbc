# SPDX-License-Identifier: GPL-2.0-or-later
# Finds a YADE that capfrac can be compiled against, or builds a minimal one.
# Sourced, never run. Sets YADE_PREFIX (the host's installation), YADE_SOURCE_DIR
# (headers of exactly the same version) and YADE_BUILT_HERE (ON where it is our build).

YADE_BUILT_HERE=OFF
SYSTEM_PATH=/usr/sbin:/usr/bin:/sbin:/bin
YADE_VERSION=2025.2.0
YADE_TARBALL=yade_$YADE_VERSION.orig.tar.bz2
YADE_SHA256=42702372251bf5e8f07a364bdf30533a1318947e4db90435b1f89293dc029156
# Why these: a file that includes YADE's core costs a minute before its own first
# line, so each library is compiled as one unity file; everything that capfrac
# does not use is off, by these options and in yade-minimal.cmake.
YADE_MINIMAL=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/yade-minimal.cmake
YADE_BUILD_OPTIONS=(
	-DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=100
	-DDISABLE_SAVE_TEMPS=ON -DDISABLE_ALL=ON -DENABLE_OPENMP=ON -DENABLE_LOGGER=ON
	-DDISABLE_PKGS=fem,lbm,levelSet,openfoam,potential,pfv,image
	"-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG"
)

yade_cache_key() {
	local flags
	flags=$(printf '%s ' "${YADE_BUILD_OPTIONS[@]}" "$(g++ -dumpfullversion)" "$(/usr/bin/python3 -V)" "$(<"$YADE_MINIMAL")" | sha256sum)
	printf 'yade-%s-%s' "$YADE_VERSION" "${flags:0:12}"
}

# debian_mirror: the address of the mirror that this machine's apt uses; empty where it has none.
debian_mirror() {
	local filter
	for filter in 'Origin: Debian' 'Created-By: Packages'; do # without lists from a mirror, its origin is not known
		apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' "$filter" | grep -v security | head -n 1 | grep . && return 0
	done
	return 0
}

# The source tarball through apt, with private lists: no root, and the
# machine's own configuration of apt stays as it is.
download_yade_source() {
	local dir=$1 mirror keyring lists=$1/apt
	mirror=$(debian_mirror)
	[[ -n $mirror ]] || die "no Debian mirror is configured for apt, so YADE's source cannot be found;
  get $YADE_TARBALL yourself, unpack it, and set YADE_SOURCE_DIR to the folder."
	mkdir -p "$lists/parts" "$lists/lists/partial"
	keyring=/usr/share/keyrings/debian-archive-keyring.gpg
	printf 'Types: deb-src\nURIs: %s\nSuites: trixie\nComponents: main\n' "$mirror" >"$lists/parts/trixie.sources"
	[[ -r $keyring ]] && printf 'Signed-By: %s\n' "$keyring" >>"$lists/parts/trixie.sources"
	local options=(-o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$lists/parts" -o Dir::State::Lists="$lists/lists"
		-o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= -o APT::Sandbox::User=)
	(cd "$dir" && apt-get "${options[@]}" -qq update && apt-get "${options[@]}" -qq source --tar-only --download-only "yade=$YADE_VERSION-1") \
		>"$dir/download.log" 2>&1 || { tail -n 10 "$dir/download.log" >&2; die "YADE's source could not be downloaded from $mirror"; }
}

# fetch_yade_source: leaves the unpacked source in the cache, once.
fetch_yade_source() {
	local dir=$CAPFRAC_CACHE/source
	YADE_SOURCE_DIR=$dir/trunk-$YADE_VERSION
	[[ -f $YADE_SOURCE_DIR/.complete ]] && return 0
	mkdir -p "$dir"
	if ! echo "$YADE_SHA256  $dir/$YADE_TARBALL" | sha256sum --check --status 2>/dev/null; then
		say "downloading the source of YADE $YADE_VERSION (30 MB)"
		rm -f "$dir/$YADE_TARBALL"
		download_yade_source "$dir"
	fi
	echo "$YADE_SHA256  $dir/$YADE_TARBALL" | sha256sum --check --status \
		|| die "$dir/$YADE_TARBALL is not the file it should be (sha256 differs); remove it and try again"
	rm -rf "$YADE_SOURCE_DIR"
	tar -xjf "$dir/$YADE_TARBALL" -C "$dir"
	[[ -f $YADE_SOURCE_DIR/ChangeLog || -f $YADE_SOURCE_DIR/CMakeLists.txt ]] || die "$YADE_TARBALL unpacked to something unexpected"
	touch "$YADE_SOURCE_DIR/.complete"
}

# yade_jobs: the processors, or fewer where memory is short: a library's unity file takes 4 GB.
yade_jobs() {
	local most=${jobs:-$(nproc)} fit
	fit=$(awk '/^MemAvailable/ { print int($2 / 4e6) }' /proc/meminfo)
	echo $((fit < 1 ? 1 : fit < most ? fit : most))
}

build_yade() {
	local key build prefix
	key=$(yade_cache_key)
	build=$CAPFRAC_CACHE/$key-build prefix=$CAPFRAC_CACHE/$key
	YADE_PREFIX=$prefix YADE_BUILT_HERE=ON
	if [[ -f $prefix/.complete ]]; then
		say "using YADE $YADE_VERSION from $prefix"
		return 0
	fi
	say "building a minimal YADE $YADE_VERSION once, into $prefix"
	say "this takes about 13 minutes on 2 cores and resumes where it stopped if interrupted"
	mkdir -p "$build"
	# A system PATH only: YADE tries every python3.N it finds, and a pyenv shim among them stops it.
	PATH=$SYSTEM_PATH cmake -S "$YADE_SOURCE_DIR" -B "$build" -G Ninja "${YADE_BUILD_OPTIONS[@]}" -DCMAKE_PROJECT_INCLUDE="$YADE_MINIMAL" \
		-DCMAKE_INSTALL_PREFIX="$prefix" -DSUFFIX=-capfrac -DPYTHON_EXECUTABLE=/usr/bin/python3 >"$build/configure.log" 2>&1 \
		|| { tail -n 30 "$build/configure.log" >&2; die "YADE could not be configured; see $build/configure.log"; }
	PATH=$SYSTEM_PATH run_logged "$build/build.log" "YADE" env NINJA_STATUS='[%f/%t] ' ninja -C "$build" -j "$(yade_jobs)"
	PATH=$SYSTEM_PATH cmake --install "$build" >"$build/install.log" 2>&1 || die "YADE could not be installed; see $build/install.log"
	# The package imports docstrings for classes that this build leaves out.
	find "$prefix" -path '*/py/yade/_extraDocs.py' -exec truncate -s 0 {} +
	touch "$prefix/.complete"
	rm -rf "$build"
}

packaged_yade_version() { dpkg-query -W -f '${Version}' yade 2>/dev/null | sed 's/-.*//'; }
offered_yade_version()  { apt-cache policy yade 2>/dev/null | sed -n 's/ *Candidate: \([^-]*\).*/\1/p'; }

# find_or_build_yade: the user's own, else the distribution's, else our build.
find_or_build_yade() {
	if [[ -n ${YADE_PREFIX:-} || -n ${YADE_SOURCE_DIR:-} ]]; then
		[[ -n ${YADE_PREFIX:-} && -n ${YADE_SOURCE_DIR:-} ]] \
			|| die "set both YADE_PREFIX (an installed YADE) and YADE_SOURCE_DIR (its source, same version), or neither"
		[[ -d $YADE_PREFIX ]] || die "YADE_PREFIX=$YADE_PREFIX is not a folder"
		[[ -d $YADE_SOURCE_DIR/core ]] || die "YADE_SOURCE_DIR=$YADE_SOURCE_DIR holds no YADE source (no core/ in it)"
		say "using your YADE in $YADE_PREFIX with the headers in $YADE_SOURCE_DIR"
		return 0
	fi
	if [[ $(packaged_yade_version) != "$YADE_VERSION" && $(offered_yade_version) == "$YADE_VERSION" ]]; then
		require_packages "${YADE_PACKAGES[@]}"
	fi
	if [[ $(packaged_yade_version) == "$YADE_VERSION" ]]; then
		require_packages "${YADE_PACKAGES[@]}"
		say "using the distribution's YADE $YADE_VERSION"
		YADE_PREFIX=/usr
		fetch_yade_source
		return 0
	fi
	require_packages "${YADE_BUILD_PACKAGES[@]}"
	fetch_yade_source
	build_yade
}
