# SPDX-License-Identifier: GPL-2.0-or-later
# Console helpers shared by the scripts: plain messages, refusals, progress.
# Sourced, never run.

say()  { printf '%s\n' "capfrac: $*"; }
warn() { printf '%s\n' "capfrac: note: $*" >&2; }
die()  { printf '%s\n' "capfrac: error: $*" >&2; exit 1; }

# make_cache: the folder in which the scripts keep what is made once (CAPFRAC_CACHE).
make_cache() {
	CAPFRAC_CACHE=${CAPFRAC_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/capfrac}
	mkdir -p "$CAPFRAC_CACHE" 2>/dev/null || die "the cache folder $CAPFRAC_CACHE cannot be written; set CAPFRAC_CACHE to one that can"
}

# Ctrl-C and TERM: what runs is stopped, too, and one sentence says how to go on. Exit status 130, as that of capfrac.
attended_process='' starting='' signal_while_starting=''
interrupted() {
	local signal=$1
	if [[ -n $starting ]]; then # answered as soon as it is known what has to be stopped
		signal_while_starting=$signal
		return
	fi
	trap '' INT TERM
	if [[ -n $attended_process ]]; then
		# Ctrl-C in a terminal has reached it already; a second one would disturb what it saves.
		[[ $signal != INT ]] || attended_ends_within 2 || true
		kill -"$signal" "$attended_process" 2>/dev/null || true
		attended_ends_within 70 || kill -KILL "$attended_process" 2>/dev/null || true
	fi
	[[ ! -t 2 ]] || printf '\n' >&2
	warn "interrupted; the same command ($0) goes on where it stopped"
	exit 130
}
attended_ends_within() {
	local tries=$(($1 * 10))
	while kill -0 "$attended_process" 2>/dev/null; do
		((tries-- > 0)) || return 1
		sleep 0.1
	done
}
trap 'interrupted INT' INT
trap 'interrupted TERM' TERM

# attended COMMAND...: runs a program so that a signal is answered at once, not when the program has ended.
attended() {
	local status=0
	starting=yes
	env --default-signal=INT "$@" <&0 & # the shell has what runs in the background ignore Ctrl-C
	attended_process=$!
	starting=''
	[[ -z $signal_while_starting ]] || interrupted "$signal_while_starting"
	wait "$attended_process" || status=$?
	attended_process=''
	return $status
}

# open_to_all FOLDER: whether every user may enter it.
open_to_all() {
	local folder
	folder=$(readlink -f "$1")
	while :; do
		(($(stat -c %a "$folder") % 2)) || return 1
		[[ $folder != / ]] || return 0
		folder=$(dirname "$folder")
	done
}

minutes() { printf '%d min %02d s' $(($1 / 60)) $(($1 % 60)); }

# show_progress LABEL: reads a build's output and turns "[done/total]" and
# "NN%" marks into one line of progress with an estimate of the time left.
# On a terminal the line is rewritten; elsewhere a line is printed every 10 %.
show_progress() {
	local label=$1 start=$SECONDS line done_ total percent shown=-10 elapsed left
	while IFS= read -r line; do
		if [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
			done_=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
		else
			continue
		fi
		percent=$((100 * done_ / (total > 0 ? total : 1)))
		elapsed=$((SECONDS - start))
		left=$((done_ > 0 ? elapsed * (total - done_) / done_ : 0))
		if [[ -t 1 ]]; then
			printf '\r  %s: %3d %% (%d of %d), about %s left   ' "$label" "$percent" "$done_" "$total" "$(minutes $left)"
		elif ((percent >= shown + 10)); then
			shown=$percent
			printf '  %s: %3d %% (%d of %d), about %s left\n' "$label" "$percent" "$done_" "$total" "$(minutes $left)"
		fi
	done
	[[ -t 1 ]] && printf '\n'
	return 0
}

# run_logged LOG LABEL COMMAND...: runs a build command, its whole output in
# LOG, progress on the console; on failure shows the end of the log and stops.
run_logged() {
	local log=$1 label=$2 status=0 reader
	shift 2
	mkdir -p "$(dirname "$log")"
	exec 3> >(tee "$log" | show_progress "$label")
	reader=$!
	attended sh -c 'exec "$@" >&3 2>&1' sh "$@" || status=$?
	exec 3>&-
	wait "$reader" || true # until all is shown
	if ((status)); then
		tail -n 30 "$log" >&2
		die "$label failed; the whole output is in $log"
	fi
}
