#!/bin/bash
# tests/releases/bytes.sh FOLDER HBR "COMPILERS" "ARCHITECTURES": layers 1 to 3 and the flat baseline of the reduced
# profile, one replication, by stage programs of each compiler for each architecture that this processor can run. All
# have to have the same bytes. HBR is the tool that runs them.
set -euo pipefail -o noglob
folder=$(mkdir -p "$1" && cd "$1" && pwd) hbr=$(realpath "$2")
cd "$(dirname "$0")/../.."
stages=(layer1 layer2 reference4d layer3 flat_arcs)
first= failed=0
for compiler in $3; do
  for architecture in $4; do
    name=$compiler-$architecture
    { cmake --fresh -S . -B "$folder/$name" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DHBR_ARCH="$architecture" \
        -DBUILD_TESTING=OFF && ninja -C "$folder/$name" layer; } >"$folder/$name.log" 2>&1 ||
      { tail "$folder/$name.log" >&2; exit 1; }
    rm -rf "$folder/$name.out"
    "$hbr" make --profile stages/profiles/reduced.toml --out "$folder/$name.out" --programs "$folder/$name/bin" \
      --replication 0 "${stages[@]}" >>"$folder/$name.log" 2>&1 || { tail "$folder/$name.log" >&2; exit 1; }
    (cd "$folder/$name.out" && find . -name '*.h5' | sort | xargs sha256sum) >"$folder/$name.sha256"
    first=${first:-$name}
    same='the same bytes'
    cmp -s "$folder/$first.sha256" "$folder/$name.sha256" || { same='OTHER BYTES' failed=1; }
    echo "$name: $(wc -l <"$folder/$name.sha256") artifacts, $same as $first"
  done
done
exit $failed
