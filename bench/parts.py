#!/usr/bin/env python3
"""What the beds and drives of a store took, by part: bench/parts.py STORE > bench/<machine>/<name>.csv

A row is a run: CPU seconds of all its threads, wall seconds, the seconds of each part on the first thread, and counters that no
machine changes. `rest` is the wall time that no part counts: building the run, records, checkpoints. Runs that were resumed have
only the last worker's times and are left out.
"""

import argparse
import csv
import json
import pathlib
import sys

COUNTERS = ("steps", "rebuilds", "corrections", "factorisations", "meshes")


def scene_of(manifest):
    """Fluid density [kg/m3], tip and speed [m/s] of a drive at constant speed; a bed has none."""
    scene = manifest["scene"]
    if manifest["kind"] == "bed":
        return {}
    fluid, pile = scene.get("fluid"), scene["pile"]
    return {"fluid[kg/m3]": fluid["density"] if fluid else "dry", "tip": "flat" if pile["tip"] == "flat" else next(iter(pile["tip"])),
            "speed[m/s]": pile["driving"].get("constant", {}).get("speed", "")}


def row_of(manifest):
    result, made = manifest["result"], manifest["provenance"]
    metrics = {m["name"]: m["value"] for m in result["metrics"]}
    parts = {f"{p['part']}[s]": p["seconds"] for p in result["profile"]}
    wall = made["wall_seconds"]
    return ({"kind": manifest["kind"], "case": manifest["case"][:10]} | scene_of(manifest)
            | {"cpu[s]": made["cpu_seconds"], "wall[s]": wall}
            | parts | {"rest[s]": wall - sum(parts.values())}
            | {name: int(metrics[name]) for name in COUNTERS if name in metrics})


def main(store):
    manifests = [json.loads(p.read_text()) for p in sorted(store.glob("cases/*/*/manifest.json"))]
    rows = [row_of(m) for m in manifests if m["kind"] in ("bed", "drive") and m["provenance"]["attempts"] == 1]
    columns = list(dict.fromkeys(name for row in sorted(rows, key=len, reverse=True) for name in row))
    writer = csv.DictWriter(sys.stdout, columns, restval="", lineterminator="\n")
    writer.writeheader()
    for row in sorted(rows, key=lambda r: r["cpu[s]"]):
        writer.writerow({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in row.items()})


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("store", type=pathlib.Path, help="folder of all results, as of runner --store")
    store = parser.parse_args().store
    if not (store / "cases").is_dir():
        parser.error(f"{store} holds no results: it has no folder cases")
    main(store)
