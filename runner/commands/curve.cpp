#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "runner/commands/command.h"
#include "runner/commands/curve_runs.h"
#include "runner/commands/site.h"
#include "runner/execute/exit_codes.h"
#include "runner/present/cpt_table.h"
#include "runner/present/normalised.h"
#include "runner/present/replicates.h"
#include "runner/present/series_figure.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kIdDigits = 10;  // of a case in the name of a file

struct CurveArguments {
  std::string study, root = "results", out, against;
  std::vector<std::string> where, of;
  bool bands = false, normalised = false, cpt = false;
  SiteArguments site;
};

bool is_picture(const CurveArguments& arguments) { return fs::path(arguments.out).extension() == ".svg"; }

/// The columns that are asked for. Without a word, of a drive all, of both series in a saturated bed; of a
/// basin the error of its volume, and the wave or the force on its pile, over time.
std::vector<std::string> columns_of(const CurveArguments& arguments, const CurveRuns& found) {
  const std::vector<std::string> known = present::column_names(found.series);
  const bool is_basin = found.series == present::Series::water;
  const bool all = arguments.of == std::vector<std::string>{"all"} || (!is_basin && arguments.of.empty());
  std::vector<std::string> wanted = all ? present::held_columns(found.sources, found.series) : arguments.of;
  if (wanted.empty()) {
    wanted = {"volume_error"};
    if (found.without_pile) wanted.emplace_back("wave");
    if (found.with_pile) wanted.emplace_back("pile_force_y");
  }
  std::vector<std::string> columns;
  if (!arguments.against.empty()) {
    columns = {arguments.against};
  } else if (!all) {
    columns = {is_basin ? "time" : "depth"};
  }
  for (const std::string& name : wanted) {
    if (std::ranges::find(columns, name) == columns.end()) columns.push_back(name);
  }
  for (const std::string& name : columns) {
    if (std::ranges::find(known, name) == known.end())
      throw UsageError(fmt::format("there is no column \"{}\"; there are {}", name, fmt::join(known, ", ")));
  }
  return columns;
}

/// CSV to the file that was named, or to standard output.
void put(const CurveArguments& arguments, const std::function<void(std::FILE*)>& write) {
  arguments.out.empty() ? write(stdout) : write_file(arguments.out, write);
}

void put(const CurveArguments& arguments, const std::string& text) {
  put(arguments, [&](std::FILE* out) { std::fwrite(text.data(), 1, text.size(), out); });
}

void draw(const auto& figure, const std::string& svg) {
  try {
    present::draw(figure, svg);
  } catch (const store::StoreError& error) {
    throw UsageError(error.what());
  }
  fmt::print("{}\n", svg);
}

/// The columns as a picture, the first of them as its abscissa.
void draw_columns(const CurveRuns& found, const std::vector<std::string>& columns, const std::string& title,
                  const std::string& svg) {
  if (columns.size() < 2) throw UsageError("--out: a picture needs a column over another one");
  if (columns.size() > 1 + present::kMostPanels)
    throw UsageError(fmt::format("--out: a picture has at most {} columns; name them with --of", present::kMostPanels));
  draw(present::series_figure(title, found.sources, found.series, columns), svg);
}

/// The picture that a study ends with: depth downwards, packings of the same case together.
present::Figure bands_figure(const CurveRuns& found, const std::string& title) {
  present::Figure figure{title, {}};
  for (const present::PackedCase& one : present::packed(found.sources)) {
    present::CurveGroup group{present::legend_text(one.labels), {}};
    for (const auto& source : one.packings) group.packings.push_back(present::read_resistance(source.run_folder));
    figure.groups.push_back(std::move(group));
  }
  return figure;
}

/// Standard output takes the table of one run; files get one each.
void write_cpt(const CurveArguments& arguments, const std::vector<present::CurveSource>& sources) {
  const fs::path out = arguments.out;
  if (out.empty()) {
    if (sources.size() > 1) {
      throw UsageError(
          fmt::format("--cpt: {} runs match, and standard output takes one; give --out FILE.csv for a "
                      "file of each, or --where",
                      sources.size()));
    }
    fmt::print("{}", present::cpt_csv(present::cpt_table(sources.front())));
    return;
  }
  const std::chrono::year_month_day today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  for (const present::CurveSource& source : sources) {
    const present::CptTable table = present::cpt_table(source);
    const std::string text = out.extension() == ".gef" ? present::cpt_gef(table, today) : present::cpt_csv(table);
    const std::string id = sources.size() == 1 ? "" : "-" + source.case_id.substr(0, kIdDigits);
    const fs::path file = out.parent_path() / (out.stem().string() + id + out.extension().string());
    write_file(file, [&](std::FILE* stream) { std::fwrite(text.data(), 1, text.size(), stream); });
    fmt::print("{}\n", file.string());
  }
}

void write_normalised(const CurveArguments& arguments, const CurveRuns& found,
                      const std::vector<present::SiteCurve>& site, const std::string& title) {
  const auto runs = present::normalised(found.sources);
  if (is_picture(arguments)) {
    draw(present::normalised_figure(title, runs, site, arguments.bands), arguments.out);
  } else {
    put(arguments, arguments.bands ? present::normalised_bands_csv(runs, site) : present::normalised_csv(runs, site));
  }
}

/// What does not fit together, before anything is read.
void check(const CurveArguments& arguments) {
  const fs::path out = arguments.out;
  if (arguments.bands && arguments.study.empty())
    throw UsageError("--bands needs a STUDY: its labels say which runs are packings of the same case");
  if (!arguments.site.files.empty() && !arguments.normalised) {
    throw UsageError(
        "--overlay needs --normalised: a bed of discs and a site differ in size, weight and dimension, and resistances "
        "in pascals over metres would compare what is not comparable");
  }
  if (out.extension() == ".gef" && !arguments.cpt)
    throw UsageError("--out: GEF holds the table of a cone penetration test; ask for it with --cpt");
  if (!arguments.cpt || out.empty()) return;
  if (out.extension() != ".csv" && out.extension() != ".gef")
    throw UsageError(fmt::format("--out: {} is no name for --cpt; allowed: FILE.csv, FILE.gef", arguments.out));
  if (out.extension() == ".gef" && out.filename().string().find("simulated") == std::string::npos) {
    throw UsageError(
        "--out: a GEF file that comes from no ground says so in its name, which has to contain \"simulated\"");
  }
}

int curve(const CurveArguments& arguments) {
  check(arguments);
  const std::vector<present::SiteCurve> site = read_sites(arguments.site);
  const std::string study = study_name(arguments.study);
  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  if (!is_known(study, catalogue)) return execute::kNothingMatched;
  const CurveRuns found =
      curve_runs(catalogue, arguments.root, study, arguments.where, arguments.bands || arguments.cpt);
  if (found.sources.empty()) {
    fmt::print(stderr, "nothing matched\n");
    return execute::kNothingMatched;
  }
  const std::string title = study.empty() ? "All runs" : study;
  if (found.series == present::Series::water) {
    if (arguments.bands) throw UsageError("--bands: basins have no packings");
    if (arguments.normalised) throw UsageError("--normalised: basins have no ground");
    if (arguments.cpt) throw UsageError("--cpt: basins have no ground");
  }
  if (arguments.cpt) {
    write_cpt(arguments, found.sources);
  } else if (arguments.normalised) {
    write_normalised(arguments, found, site, title);
  } else if (arguments.bands && is_picture(arguments)) {
    draw(bands_figure(found, title), arguments.out);
  } else if (arguments.bands) {
    put(arguments, [&](std::FILE* out) { present::write_bands(found.sources, out); });
  } else if (const auto columns = columns_of(arguments, found); is_picture(arguments)) {
    draw_columns(found, columns, title, arguments.out);
  } else {
    put(arguments, [&](std::FILE* out) { present::write_curves(found.sources, found.series, columns, out); });
  }
  return execute::kDone;
}

}  // namespace

void add_curve(CLI::App& app, Call& call) {
  static CurveArguments arguments;
  CLI::App* command = app.add_subcommand("curve", "Write the series of runs as CSV, a row per record, or as a picture");
  command->add_option("STUDY", arguments.study, "Name or file of a study; default: every run");
  add_where_option(*command, arguments.where);
  CLI::Option* of = command
                        ->add_option("--of", arguments.of,
                                     "Columns to write; all: every one that a run has; default: of drives all, of "
                                     "basins volume_error and wave or "
                                     "pile_force_y")
                        ->type_name("NAME,...")
                        ->delimiter(',');
  CLI::Option* against =
      command
          ->add_option("--against", arguments.against, "Column before those; default: of drives depth, of basins time")
          ->type_name("NAME");
  command
      ->add_option("--out", arguments.out,
                   "File to write: CSV, .svg for a picture, .gef with --cpt; default: standard output")
      ->type_name("FILE");
  CLI::Option* bands =
      command->add_flag("--bands", arguments.bands,
                        "A row per case and 0.05 m of depth: n packings, mean tip resistance and its 95 % interval");
  CLI::Option* normalised = command->add_flag(
      "--normalised", arguments.normalised,
      "Tip resistance over the vertical effective stress of the bed, against depth over width of the pile");
  command
      ->add_flag("--cpt", arguments.cpt,
                 "The table of a cone penetration test, a reading per 0.02 m: CSV, or GEF-CPT; a file for each run")
      ->excludes(of)
      ->excludes(against)
      ->excludes(bands)
      ->excludes(normalised);
  for (CLI::Option* option : {of, against}) option->excludes(bands)->excludes(normalised);
  add_site_options(*command, arguments.site);
  add_store_option(*command, arguments.root);
  command->footer(
      "Drives into a saturated bed have the columns of the grains and those of the fluid, row by row. Where both have\n"
      "one of a name, the fluid's is named \"fluid:kinetic_energy\". In dry drives beside them those of the fluid are "
      "nan.\n"
      "\n"
      "Normalised curves and tables of penetration tests are explained in docs/site_data.md.\n"
      "\n"
      "Examples:\n"
      "  runner curve tip_shape --out curves.csv\n"
      "  runner curve density --bands --out bands.csv\n"
      "  runner curve density --bands --out bands.svg\n"
      "  runner curve density --normalised --bands --out normalised.svg\n"
      "  runner curve density --normalised --bands --overlay site.gef --site-unit-weight \"18 kN/m3\" \\\n"
      "    --site-water-depth \"0 m\" --out overlay.svg\n"
      "  runner curve tip_shape --where \"pile.tip = flat\" --cpt --out simulated.gef\n"
      "  runner curve wave --of kinetic_energy,potential_energy --against time\n"
      "  runner curve wave --out wave.svg\n"
      "  runner curve campaign --where \"fluid != null\" --of tip_resistance,shoulder_pressure --out pressure.svg\n"
      "  runner curve velocity --where \"pile.driving.constant.speed < 0.3\" | head");
  command->callback([&call] { call = [] { return curve(arguments); }; });
}

}  // namespace seapile::commands
