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
	local log=$1 label=$2
	shift 2
	mkdir -p "$(dirname "$log")"
	if ! "$@" 2>&1 | tee "$log" | show_progress "$label"; then
		tail -n 30 "$log" >&2
		die "$label failed; the whole output is in $log"
	fi
}
