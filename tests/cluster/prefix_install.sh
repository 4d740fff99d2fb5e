#!/usr/bin/env bash
# An install works from its prefix, without root and without the tree that it was built in:
#   prefix_install.sh BUILD_FOLDER SCRATCH_FOLDER
# Installs, moves the prefix elsewhere, and runs a study of grains and one of water, which needs the mesher's module; the
# program is to load that from the prefix alone.
set -euo pipefail
build=$1
scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch/work"
cmake --install "$build" --prefix "$scratch/first place" > "$scratch/install.log"
mv "$scratch/first place" "$scratch/second place"
runner="$scratch/second place/bin/runner"

if readelf -d "$runner" "$scratch/second place/lib/seapile/"*.so | grep -E 'R(UN)?PATH' | grep -vF '[$ORIGIN'; then
  echo "an installed file looks for libraries at a place of the build machine" >&2
  exit 1
fi
cd "$scratch/work"
cat > grains.json << 'STUDY'
{"study": "grains", "question": "Does an install drive a pile?",
 "base": {"bed": {"domain": {"width": "0.8 m", "height": "1.5 m"},
                  "grains": {"count": 200, "radius": {"min": "0.02 m", "max": "0.03 m"}}},
          "pile": {"radius": "0.05 m", "depth": "0.1 m", "driving": {"constant": {"speed": "0.4 m/s"}}},
          "fluid": null}}
STUDY
"$runner" grains.json
cat > water.json << 'STUDY'
{"study": "water", "question": "Does an install make a mesh?",
 "base": {"basin": {"surface": {"initial": {"cosine": {}}}, "mesh": {"pattern": "unstructured"},
                    "time": {"step": 0.01, "duration": 0.05}}},
 "record": {"interval": 0.05, "times": [0.05]}}
STUDY
LD_DEBUG=libs LD_DEBUG_OUTPUT="$scratch/libs" "$runner" water.json
# What the dynamic linker has initialised: the module of the prefix, and no other.
cat "$scratch"/libs.* | grep -oE 'calling init: .*libseapile_mesher.so' | sort -u > "$scratch/mesher.txt"
[ "$(cat "$scratch/mesher.txt")" = "calling init: $scratch/second place/bin/../lib/seapile/libseapile_mesher.so" ]
[ "$(find "$scratch/work" -name manifest.json | wc -l)" = 3 ]
