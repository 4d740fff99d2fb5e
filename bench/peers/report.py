"""What is recorded, as tables for people."""

from programs import OUR_USUAL, REFERENCE_STIFFNESS, Failed, equivalence
from tables import interpolate, print_table, standard_error

MARGIN = 0.05  # of a ratio of forces, less 1
VERDICT = ["beds", "ratio", "95 % interval", f"verdict at {100 * MARGIN:g} %", "resolved margin",
           f"beds needed for {100 * MARGIN:g} %"]


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


def refuse_mixed(rows):
    """Ratios bed by bed mean something for one scene, one state per seed, and one force per run."""
    for name in ("tip", "speed", "grains", "from", "end"):
        if len({r[name] for r in rows}) > 1:
            raise Failed(f"force.csv mixes rows of different {name}: {', '.join(sorted({str(r[name]) for r in rows}))}")
    beds, forces = {}, {}
    for r in rows:
        if beds.setdefault(r["seed"], r["solid_fraction"]) != r["solid_fraction"]:
            raise Failed(f"force.csv has two beds of seed {r['seed']:.0f}: their solid fractions differ")
        if forces.setdefault((setting(r), r["seed"]), r["force_mean"]) != r["force_mean"]:
            raise Failed(f"force.csv has two forces of {r['code']} at {r['solves'] or r['kn']:g} with seed {r['seed']:.0f}")


def setting(row):
    return row["code"], row["solves"] or row["kn"], row["dt"]


def mean(values):
    return sum(values) / len(values)


def residual(by_seed, seeds):
    """Mean over the beds; of the peers there is none."""
    values = [by_seed[s].get("residual", "") for s in seeds]
    return f"{mean(values):.2g}" if values and "" not in values else "-"


def judged(by_seed, against, peer_pairs):
    """Cells below VERDICT, on the beds that both have: of the ratio to what stands `against`."""
    seeds = sorted(by_seed.keys() & against.keys())
    found = equivalence(peer_pairs, [(against[s]["force_mean"], by_seed[s]["force_mean"]) for s in seeds], MARGIN)
    cells = [f"{found['n']}", f"{found['ratio']:.3f}"]
    if found["n"] == 1:
        return cells + ["one bed", found["verdict"], "-", "-"]
    return cells + [f"{found['low']:.3f} - {found['high']:.3f}", found["verdict"], f"{100 * found['resolved_margin']:.2f} %",
                    f"{found['needed'] or 'over a million'}"]


def print_force(rows, peer_pairs):
    refuse_mixed(rows)
    groups = {}
    order = ["ours", "nonsmooth"]  # and then the peers by name
    place = lambda r: (order.index(r["code"]) if r["code"] in order else len(order), setting(r), r["seed"])
    for r in sorted(rows, key=place):
        groups.setdefault(setting(r), {})[r["seed"]] = r
    usual = next((v for k, v in groups.items() if k[:2] == ("ours", OUR_USUAL)), {})
    error = lambda value, digits: f"{value:.{digits}f}" if value == value else "one bed"
    lines = []
    for (code, solves, dt), by_seed in groups.items():
        values = [r["force_mean"] for r in by_seed.values()]
        shared = [by_seed[s]["force_mean"] / usual[s]["force_mean"] for s in by_seed if s in usual]
        lines.append([code, f"{solves:g}", f"{dt:g}", f"{len(values)}", f"{mean(values):.0f}", error(standard_error(values), 0),
                      f"{mean(shared):.3f} ({error(standard_error(shared), 3)})" if shared else "-", residual(by_seed, by_seed)])
    print_table(["code", "sub-steps, sweeps or kn N/m", "dt s", "beds", "mean force N/m", "s.e. over beds",
                 "ratio to ours, bed by bed (s.e.)", "rms residual m/s"], lines)

    lines = [[code, f"{solves:g}", f"{dt:g}", *judged(by_seed, usual, peer_pairs)]
             for (code, solves, dt), by_seed in groups.items() if by_seed is not usual and by_seed.keys() & usual.keys()]
    if lines:
        print(f"Against ours with {OUR_USUAL} sub-steps, bed by bed:\n")
        print_table(["code", "sub-steps, sweeps or kn N/m", "dt s", *VERDICT], lines)

    *fewer, most = [(k[1], v) for k, v in groups.items() if k[0] == "nonsmooth"] or [None]
    lines = [[f"{sweeps:g}", residual(by_seed, seeds), f"{most[0]:g}", residual(most[1], seeds), *judged(by_seed, most[1], peer_pairs)]
             for sweeps, by_seed in fewer if (seeds := by_seed.keys() & most[1].keys())]
    if lines:
        print("The non-smooth method against itself with the most sweeps: whether its residual is small enough, bed by bed:\n")
        print_table(["sweeps", "rms residual m/s", "most sweeps", "rms residual m/s", *VERDICT], lines)
