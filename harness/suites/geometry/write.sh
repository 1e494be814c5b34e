#!/usr/bin/env bash
# Writes geometry.toml and its scenes into out/geometry: meshes of up to a million triangles, textures, glass, lights.
#   harness/suites/geometry/write.sh [PROGRAM]
# 60 MB in two seconds.
set -euo pipefail
cd "$(dirname "$0")/../../.."
program=${1:-build/release/bin/photonproof}
folder=out/geometry
mkdir -p "$folder"
cp harness/suites/geometry/geometry.toml "$folder/"
for scene in door-ajar gallery glass-interior ring-caustic; do
  rm -rf "${folder:?}/$scene"
  cp -r "scenes/showcase/$scene" "$folder/$scene"
done
"$program" generate showcase --detail 10 --force -o "$folder" >"$folder/written.txt"
"$program" generate million --triangles 1e6 --force -o "$folder/landscape"
"$program" generate many-lights --lights 1000 --force -o "$folder/many-lights"
echo "$folder/geometry.toml"
