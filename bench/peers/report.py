"""What is recorded, as tables for people."""

from programs import OUR_USUAL, REFERENCE_STIFFNESS
from tables import interpolate, print_table, standard_error


def print_cost(rows):
    percent = lambda v: f"{100 * v:.3f} %"
    print_table(["code", "setting", "ranks", "kn N/m, sub-steps or sweeps", "dt s", "CPU s / s", "wall s / s", "p99.9", "mean", "max",
                 "force N/m (block s.e.)"],
                [[r["code"], r["setting"], f"{r['ranks']:.0f}", f"{r['kn'] or r['solves']:g}", f"{r['dt']:.4g}",
                  f"{r['cpu_per_s']:.2f}", f"{r['wall_per_s']:.2f}", percent(r["overlap_p999"]), percent(r["overlap_mean"]),
                  percent(r["overlap_max"]), f"{r['force_mean']:.0f} ({r['force_se']:.0f})"] for r in rows])
    ours = [r for r in rows if r["code"] == "ours"]
    peers = sorted({(r["code"], r["setting"]) for r in rows if r["code"] != "ours"})
    single = lambda code, setting: [r for r in rows if (r["code"], r["setting"], r["ranks"]) == (code, setting, 1)]

    lines = []
    for our in ours:
        for code, setting in peers:
            points = [(r["overlap_p999"], r["cpu_per_s"], f"{r['kn']:g}") for r in single(code, setting)]
            found = interpolate(points, our["overlap_p999"])
            lines.append([f"{our['solves']:.0f}", percent(our["overlap_p999"]), f"{our['cpu_per_s']:.2f}", code, setting] +
                         ([f"{found[0]:.1f}", f"{found[2]} - {found[1]}", f"{found[0] / our['cpu_per_s']:.1f}"] if found
                          else ["-", "outside what was run", "-"]))
    print("At equal 99.9th percentile of the overlaps, between the two stiffnesses around it:\n")
    print_table(["our sub-steps", "p99.9", "our CPU s / s", "code", "setting", "its CPU s / s", "kn N/m", "ratio"], lines)

    usual = next((r for r in ours if r["solves"] == OUR_USUAL), None)
    if usual:
        print("At usual settings:\n")
        print_table(["code", "setting", "CPU s / s", "p99.9", "ratio of cost"],
                    [[r["code"], f"kn {r['kn']:g} N/m, dt {r['dt']:.3g} s, {r['setting']}", f"{r['cpu_per_s']:.2f}",
                      percent(r["overlap_p999"]), f"{r['cpu_per_s'] / usual['cpu_per_s']:.1f}"]
                     for r in rows if r["kn"] == REFERENCE_STIFFNESS and r["ranks"] == 1] +
                    [["ours", f"{OUR_USUAL} sub-steps", f"{usual['cpu_per_s']:.2f}", percent(usual["overlap_p999"]), "1"]])


def print_force(rows):
    groups = {}
    for r in rows:
        groups.setdefault((r["code"], r["solves"] or r["kn"]), {})[r["seed"]] = r["force_mean"]
    ours = next((v for k, v in groups.items() if k == ("ours", OUR_USUAL)), {})
    error = lambda value, digits: f"{value:.{digits}f}" if value == value else "one bed"
    lines = []
    for (code, setting), by_seed in groups.items():
        values = list(by_seed.values())
        shared = [by_seed[s] / ours[s] for s in by_seed if s in ours]
        lines.append([code, f"{setting:g}", f"{len(values)}", f"{sum(values) / len(values):.0f}", error(standard_error(values), 0),
                      f"{sum(shared) / len(shared):.3f} ({error(standard_error(shared), 3)})" if shared else "-"])
    print_table(["code", "sub-steps, sweeps or kn N/m", "beds", "mean force N/m", "s.e. over beds", "ratio to ours, bed by bed (s.e.)"], lines)
