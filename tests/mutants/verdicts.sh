# The verdicts that are kept: `tests/mutants/verdicts/CRATE`, a line a fault: verdict, seed of the sample, date, checksum of the file with
# the fault, fault. One holds as long as that file is what it was.
kept() { printf 'tests/mutants/verdicts/%s' "$1"; }

checksum() { cksum "$1" 2>/dev/null | cut -d' ' -f1; }

# Those of a crate that hold: verdict, seed, date, fault.
holding() {
    [ -f "$(kept "$1")" ] || return 0
    while IFS=$(printf '\t') read -r verdict seed date sum fault; do
        [ "$(checksum "${fault%%:*}")" != "$sum" ] || printf '%s\t%s\t%s\t%s\n' "$verdict" "$seed" "$date" "$fault"
    done <"$(kept "$1")"
}

# A fault without its line and column, which move: `crates/x/src/y.rs: replace ...`.
unplaced() { sed 's/^\([^:]*\):[0-9]*:[0-9]*: /\1: /'; }

# Why a survivor may, or nothing.
reason() { grep -F -- "$(printf '%s\n' "$1" | unplaced)$(printf '\t')" tests/mutants/known | cut -f2- || true; }
