#include "runner/present/series_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

struct CurveArguments {
  std::string study, root = "results", out, against;
  std::vector<std::string> where, of;
  bool bands = false;
};

/// Runs with a series, all of the same.
struct Found {
  std::vector<present::CurveSource> sources;
  present::Series series = present::Series::grains;
  bool with_pile = false, without_pile = false;  ///< of basins
};

Found find(const CurveArguments& arguments, const std::string& study, const store::Catalogue& catalogue) {
  Found drives, basins;
  basins.series = present::Series::water;
  for (const auto& [folder, labels] : usage_checked([&] { return catalogue.runs(study, arguments.where); })) {
    const store::Manifest manifest = store::read_manifest(folder);
    if (arguments.bands && manifest.result.outcome != simulation::Outcome::completed) continue;
    const bool is_drive = manifest.header.kind == "drive", has_fluid = manifest.flow_records > 0;
    const bool is_basin = has_fluid && !is_drive;
    if (!is_drive && !is_basin) continue;
    if (is_drive && has_fluid) drives.series = present::Series::both;
    (is_drive ? drives : basins).sources.push_back({manifest.header.case_id, manifest.run, labels, folder});
    const auto pile = std::ranges::find(manifest.header.parts, "pile", &simulation::Part::name);
    const bool has_pile = pile != manifest.header.parts.end() && pile->built;
    (has_pile ? basins.with_pile : basins.without_pile) |= is_basin;
  }
  if (drives.sources.empty()) return basins;
  if (basins.sources.empty()) return drives;
  throw UsageError("drives and basins have no columns in common: --where \"kind = drive\" or \"kind = flow\"");
}

/// The columns that are asked for. Without a word, of a drive all, of both series in a saturated bed; of a
/// basin the error of its volume, and the wave or the force on its pile, over time.
std::vector<std::string> columns_of(const CurveArguments& arguments, const Found& found) {
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

void write(const Found& found, const std::vector<std::string>& columns, bool bands, std::FILE* out) {
  bands ? present::write_bands(found.sources, out) : present::write_curves(found.sources, found.series, columns, out);
}

/// The columns as a picture, the first of them as its abscissa.
void draw(const Found& found, const std::vector<std::string>& columns, const std::string& title,
          const std::string& svg) {
  if (columns.size() < 2) throw UsageError("--out: a picture needs a column over another one");
  if (columns.size() > 1 + present::kMostPanels)
    throw UsageError(fmt::format("--out: a picture has at most {} columns; name them with --of", present::kMostPanels));
  const auto figure = present::series_figure(title, found.sources, found.series, columns);
  try {
    present::draw(figure, svg);
  } catch (const store::StoreError& error) {
    throw UsageError(error.what());
  }
  fmt::print("{}\n", svg);
}

int curve(const CurveArguments& arguments) {
  if (arguments.bands && arguments.study.empty())
    throw UsageError("--bands needs a STUDY: its labels say which runs are packings of the same case");
  const std::string study = study_name(arguments.study);
  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  if (!is_known(study, catalogue)) return execute::kNothingMatched;
  const Found found = find(arguments, study, catalogue);
  if (found.sources.empty()) {
    fmt::print(stderr, "nothing matched\n");
    return execute::kNothingMatched;
  }
  if (arguments.bands && found.series == present::Series::water) throw UsageError("--bands: basins have no packings");
  const std::vector<std::string> columns = columns_of(arguments, found);
  if (arguments.out.empty()) {
    write(found, columns, arguments.bands, stdout);
    return execute::kDone;
  }
  if (std::filesystem::path(arguments.out).extension() == ".svg") {
    if (arguments.bands) throw UsageError("--bands are CSV: the picture that a study ends with shows them");
    draw(found, columns, study.empty() ? "All runs" : study, arguments.out);
    return execute::kDone;
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(arguments.out.c_str(), "w"), std::fclose);
  if (!file) throw UsageError(fmt::format("{} cannot be written: {}", arguments.out, std::strerror(errno)));
  write(found, columns, arguments.bands, file.get());
  return execute::kDone;
}

}  // namespace

void add_curve(CLI::App& app, Call& call) {
  static CurveArguments arguments;
  CLI::App* command = app.add_subcommand("curve", "Write the series of runs as CSV, a row per record, or as a picture");
  command->add_option("STUDY", arguments.study, "Name or file of a study; default: every run");
  add_where_option(*command, arguments.where);
  command
      ->add_option(
          "--of", arguments.of,
          "Columns to write; all: every one that a run has; default: of drives all, of basins volume_error and wave or "
          "pile_force_y")
      ->type_name("NAME,...")
      ->delimiter(',');
  command->add_option("--against", arguments.against, "Column before those; default: of drives depth, of basins time")
      ->type_name("NAME");
  command->add_option("--out", arguments.out, "File to write: CSV, or .svg for a picture; default: standard output")
      ->type_name("FILE");
  command->add_flag("--bands", arguments.bands,
                    "A row per case and 0.05 m of depth: n packings, mean tip resistance and its 95 % interval");
  add_store_option(*command, arguments.root);
  command->footer(
      "Drives into a saturated bed have the columns of the grains and those of the fluid, row by row. Where both have\n"
      "one of a name, the fluid's is named \"fluid:kinetic_energy\". In dry drives beside them those of the fluid are "
      "nan.\n"
      "\n"
      "Examples:\n"
      "  runner curve tip_shape --out curves.csv\n"
      "  runner curve density --bands --out bands.csv\n"
      "  runner curve wave --of kinetic_energy,potential_energy --against time\n"
      "  runner curve wave --out wave.svg\n"
      "  runner curve campaign --where \"fluid != null\" --of tip_resistance,shoulder_pressure --out pressure.svg\n"
      "  runner curve velocity --where \"pile.driving.constant.speed < 0.3\" | head");
  command->callback([&call] { call = [] { return curve(arguments); }; });
}

}  // namespace seapile::commands
