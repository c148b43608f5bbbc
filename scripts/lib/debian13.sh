# SPDX-License-Identifier: GPL-2.0-or-later
# A bare Debian 13 in a folder of the cache, in which the README's commands run as they would for a new user there.
# Sourced, never run. Needs root, console.sh, packages.sh and yade.sh.

# Everything that mounts runs under here: mounts and processes are its own and are gone when it ends, however it ends,
# so that neither Ctrl-C nor `rm` of the folder can ever meet this machine's /dev or /proc.
apart() { attended unshare --mount --pid --fork --kill-child --mount-proc "$@"; }

require_debian13_host() {
	((EUID == 0)) || die "a Debian 13 beside this system can be set up by root only (debootstrap, chroot);
  run:  sudo scripts/test --debian13"
	apart true 2>/dev/null || die "this system does not let root mount (a container without that right?):
  no Debian 13 can be set up in it"
	require_packages debootstrap debian-archive-keyring git
}

# give_network DIR: what this machine reaches its mirror by: names, addresses, the proxies of its apt.
give_network() {
	local file
	for file in /etc/resolv.conf /etc/hosts; do
		[[ ! -e $file ]] || cp --dereference --remove-destination "$file" "$1$file"
	done
	apt-config dump | grep -iE '^Acquire::https?::(Proxy|Proxy-Auto-Detect)(::[^ ]*)? ' \
		>"$1/etc/apt/apt.conf.d/80host-proxy" || true
}

# make_debian13 DIR: Debian's smallest system, once; an interrupted try is thrown away, since debootstrap cannot go on.
make_debian13() {
	local dir=$1 mirror keyring=/usr/share/keyrings/debian-archive-keyring.gpg
	[[ -f $dir.complete ]] && return 0
	mirror=$(debian_mirror)
	[[ -n $mirror ]] || die "no Debian mirror is configured for apt on this machine, so Debian 13 cannot be found"
	rm -rf --one-file-system "$dir"
	mkdir -p "$dir"
	say "setting up a bare Debian 13 in $dir, once (some two minutes)"
	apart debootstrap --variant=minbase --include=ca-certificates --keyring="$keyring" trixie "$dir" "$mirror" 2>&1 \
		| tee "$dir.log" | sed -unE 's/^I: (.* (packages|system)\.\.\.|.* successfully\.)$/  \1/p' \
		|| { tail -n 10 "$dir.log" >&2; die "debootstrap could not get Debian 13 from $mirror; its output is in $dir.log"; }
	touch "$dir.complete"
}

# put_clone DIR: the last commit of this repository as a clone in DIR. What was built there stays, as the build takes up
# what changed; results of earlier runs go.
put_clone() {
	local dir=$1 changed
	changed=$(git -c safe.directory='*' -C "$root" status --porcelain | wc -l)
	((changed == 0)) || warn "the last commit is tested; $changed files that differ from it are not"
	[[ -d $dir/.git ]] || git init -q "$dir"
	# Root may read a clone of another user, which git refuses unless told.
	git -C "$dir" fetch -q --update-shallow --upload-pack="git -c safe.directory='*' upload-pack" "$root" HEAD
	git -C "$dir" -c advice.detachedHead=false checkout -q -f --detach FETCH_HEAD
	git -C "$dir" clean -q -fdx -e /build
	say "Debian 13: commit $(git -C "$dir" log -1 --format='%h (%s)')"
}

# in_debian13 DIR COMMAND...: runs a command in the clone in there, as root, with a bare environment; its status.
in_debian13() {
	local dir=$1 name proxies=()
	shift
	for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
		[[ -z ${!name:-} ]] || proxies+=("$name=${!name}")
	done
	# The first process of its own /proc ignores signals that it has no handler for.
	apart bash -c '
		set -e
		trap "exit 130" INT
		trap "exit 143" TERM
		root=$1; shift
		mount --types proc proc "$root/proc"
		mount --rbind /sys "$root/sys"
		mount --rbind /dev "$root/dev"
		status=0
		chroot "$root" "$@" || status=$?
		exit $status
	' in_debian13 "$dir" /usr/bin/env -i "PATH=/usr/local/sbin:/usr/local/bin:$SYSTEM_PATH" HOME=/root LANG=C.UTF-8 \
		"TERM=${TERM:-dumb}" "${proxies[@]}" bash -c 'cd /root/capfrac && exec "$@"' bash "$@"
}

# mend_packages DIR: what an interrupted run left half installed; nothing to do else.
mend_packages() {
	in_debian13 "$1" env DEBIAN_FRONTEND=noninteractive \
		sh -c 'dpkg --configure -a || apt-get --fix-broken --yes --quiet install' >>"$1.log" 2>&1 \
		|| { tail -n 10 "$1.log" >&2; die "the packages in $1 cannot be mended; remove that folder and start again"; }
}

# test_on_debian13 [--validation] [ARGUMENTS FOR PYTEST]: both commands of the README; with arguments the tests alone.
test_on_debian13() {
	local dir=$CAPFRAC_CACHE/debian13 validation=() status=0 start=$SECONDS result
	[[ ${1:-} != --validation ]] || { validation=(--validation); shift; }
	require_debian13_host
	exec 8>"$dir.lock"
	flock -n 8 || { say "another test on Debian 13 is at work; waiting for it"; flock 8; }
	make_debian13 "$dir"
	give_network "$dir"
	put_clone "$dir/root/capfrac"
	mend_packages "$dir"
	if (($# == 0)); then
		say "Debian 13: scripts/demo"
		in_debian13 "$dir" scripts/demo || { status=$?; warn "scripts/demo failed on Debian 13 (status $status)"; }
		((status < 128)) || return $status
	fi
	say "Debian 13: scripts/test${validation:+ --validation}${*:+ -- $*}"
	in_debian13 "$dir" scripts/test "${validation[@]}" -- "$@" || status=$?
	((status == 0)) && result='all passed' || result="failed (status $status)"
	say "Debian 13: $result in $(minutes $((SECONDS - start)))"
	return $status
}
