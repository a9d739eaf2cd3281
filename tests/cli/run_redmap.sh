# To be sourced by tests of the program: runs `$redmap` in the current folder and counts what goes wrong in `failures`.
failures=0
fail() {
  echo "$1"
  failures=$((failures + 1))
}

# runs ARGUMENTS...: `redmap ARGUMENTS` must succeed in silence on stderr.
runs() {
  "$redmap" "$@" >stdout 2>stderr && [ ! -s stderr ] || fail "redmap $*: expected success, found: $(cat stderr)"
}

# refuses PART ARGUMENTS...: `redmap ARGUMENTS` must exit with 1 and one line on stderr that holds PART.
refuses() {
  local part=$1 status
  shift
  "$redmap" "$@" >stdout 2>stderr
  status=$?
  [ $status -eq 1 ] && [ "$(wc -l <stderr)" -eq 1 ] && grep -qF -- "$part" stderr ||
    fail "redmap $*: expected status 1 and one line with \"$part\", found status $status and: $(cat stderr)"
}

# says PART: the last command printed PART.
says() { grep -qF -- "$1" stdout || fail "expected \"$1\", found: $(cat stdout)"; }
