#!/bin/bash
# tests/releases/try.sh RELEASE FOLDER: README's two commands and all tests on a bare machine of a Debian release: a root
# folder FOLDER/RELEASE, by debootstrap, in which only git and make are installed beforehand. As root. What is tried is
# what is committed. FOLDER/RELEASE.log keeps what was said, FOLDER/RELEASE.sha256 the hashes of the layers that were
# made; those of the releases tried so far are compared.
# MNIST_DIR, WERROR: as in the Makefile. MIRROR: where Debian's packages come from, else from where this machine has them.
set -euo pipefail
release=$1 folder=$(mkdir -p "$2" && cd "$2" && pwd)
cd "$(dirname "$0")/../.."
root=$folder/$release log=$folder/$release.log
[ "$(id -u)" = 0 ] || { echo "debootstrap and chroot need root" >&2; exit 2; }
mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Label: Debian' 'Component: main' | sort -u | head -n 1)}

rm -rf "$root"
echo "$release: making a bare root"
debootstrap --variant=minbase "$release" "$root" ${mirror:+"$mirror"} >"$log" 2>&1 || { tail "$log" >&2; exit 1; }
cp /etc/resolv.conf "$root/etc/"
echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/passing"  # a root that is thrown away need not survive a crash
mkdir -p "$root/repository" "$root/mnist"
cat >"$root/try" <<'TRY'
set -euxo pipefail
[ -z "$(ls /mnist)" ] || export MNIST_DIR=/mnist
apt-get update -qq
apt-get install -y -qq --no-install-recommends git make
git config --global --add safe.directory '*'  # the repository is another user's where it is mounted
cd /root
git clone -q /repository hbr && cd hbr
make all PROFILE=reduced -j2
make audit PROFILE=reduced
make test
TRY
# The mounts are this process's own and end with it. Nothing of who calls is known there (DEPS, CXX, make's own flags)
# but the way to the packages, and whether warnings are errors.
echo "$release: README's commands, all tests ($log)"
unshare --mount --pid --fork --kill-child bash -euc '
  mount --bind "$2" "$1/repository"
  [ -z "$3" ] || mount --bind "$3" "$1/mnist"
  mount -t proc proc "$1/proc"
  mount --rbind /dev "$1/dev"
  bare=(PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive)
  for name in http_proxy https_proxy no_proxy WERROR; do [ -z "${!name:-}" ] || bare+=("$name=${!name}"); done
  exec chroot "$1" env -i "${bare[@]}" bash /try' try "$root" "$PWD" "${MNIST_DIR:-}" </dev/null >>"$log" 2>&1 ||
  { grep -E 'error|FAILED|\*\*\*' "$log" | tail >&2; echo "$release: failed; $log tells all" >&2; exit 1; }
grep -E 'tests passed' "$log"

(cd "$root/root/hbr/out/reduced" && find layer1 layer2* reference4d* layer3* flat_arcs* -name '*.h5' | sort |
  xargs sha256sum) >"$folder/$release.sha256"
for other in "$folder"/*.sha256; do
  cmp -s "$other" "$folder/$release.sha256" && same='the same bytes' || same='OTHER BYTES'
  echo "$release: $(wc -l <"$folder/$release.sha256") layers, $same as $(basename "${other%.sha256}")"
  [ "$same" != 'OTHER BYTES' ] || failed=1
done
exit ${failed:-0}
