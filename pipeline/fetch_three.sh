#!/usr/bin/env bash
# Makes sure that three.js, which draws the page's robots in three dimensions, is in a folder: its module, the controls
# of the camera and its licence (MIT). pipeline/fetch_three.sh FOLDER
#
# From the repository of three.js, else (a machine without the open internet) out of its npm package, as
# pipeline/fetch_mnist.sh has it. A file appears in FOLDER complete and with the right hash, or not at all. A page without
# it shows pictures instead.
set -euo pipefail

name=three.js otherwise="put ${1:-FOLDER}'s files there yourself"
. "$(dirname "$0")/fetch.sh"

version=0.170.0
declare -A sha256=(
  [build/three.module.min.js]=08fd7545d13d2c7fb65ab691530a802dafefd638596501854f267d0fb13c39e7
  [examples/jsm/controls/OrbitControls.js]=80efaadea4f8a636a65fb0bd08bfef62f3d93a0bb94e2e7500f23176c5c07f4e
  [LICENSE]=4c40a1ef62450b857c3b2aaf294936304cd552d965fbcd9d32d4c5bcf4ba4454
)
mirror=https://raw.githubusercontent.com/mrdoob/three.js/r170

missing() {
  local file
  for file in "${!sha256[@]}"; do
    [[ -f $1/$(basename "$file") ]] || echo "$file"
  done
}

from_mirror() {  # FILES, into $work
  local file
  for file in "$@"; do
    mkdir -p "$work/$(dirname "$file")"
    download "$mirror/$file" "$work/$file" && has_sha256 "$work/$file" "${sha256[$file]}" || return 1
  done
}

folder=${1:?usage: pipeline/fetch_three.sh FOLDER}
[[ -n $(missing "$folder") ]] || exit 0
lock_folder "$folder" "can't write to $folder: let someone who can call pipeline/fetch_three.sh $folder, or do with pictures"
mapfile -t absent < <(missing "$folder")
[[ ${#absent[@]} -gt 0 ]] || exit 0

echo "$name: fetching version $version into $folder" >&2
from_mirror "${absent[@]}" || from_npm "three@$version" 1 "${absent[@]/#/package/}"
for file in "${absent[@]}"; do
  has_sha256 "$work/$file" "${sha256[$file]}" ||
    fail "$file: expected sha256 ${sha256[$file]}, found $(sha256sum <"$work/$file" | cut -d ' ' -f 1)"
  mv "$work/$file" "$folder/$(basename "$file")"
done
