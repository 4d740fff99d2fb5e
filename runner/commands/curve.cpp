#include "runner/present/curve.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

struct CurveArguments {
  std::string study, root = "results", out;
  std::vector<std::string> where;
  bool bands = false;
};

void write(const std::vector<present::CurveSource>& sources, bool bands, std::FILE* out) {
  bands ? present::write_bands(sources, out) : present::write_curves(sources, out);
}

int curve(const CurveArguments& arguments) {
  if (arguments.bands && arguments.study.empty())
    throw UsageError("--bands needs a STUDY: its labels say which runs are packings of the same case");
  const std::string study = study_name(arguments.study);
  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  if (!is_known(study, catalogue)) return execute::kNothingMatched;
  std::vector<present::CurveSource> sources;
  for (const auto& [folder, labels] : usage_checked([&] { return catalogue.runs(study, arguments.where); })) {
    const store::Manifest manifest = store::read_manifest(folder);
    const bool completed = manifest.result.outcome == simulation::Outcome::completed;
    if (manifest.header.kind == "drive" && (completed || !arguments.bands))
      sources.push_back({manifest.header.case_id, manifest.run, labels, folder});
  }
  if (sources.empty()) {
    fmt::print(stderr, "nothing matched\n");
    return execute::kNothingMatched;
  }
  if (arguments.out.empty()) {
    write(sources, arguments.bands, stdout);
    return execute::kDone;
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(arguments.out.c_str(), "w"), std::fclose);
  if (!file) throw UsageError(fmt::format("{} cannot be written: {}", arguments.out, std::strerror(errno)));
  write(sources, arguments.bands, file.get());
  return execute::kDone;
}

}  // namespace

void add_curve(CLI::App& app, Call& call) {
  static CurveArguments arguments;
  CLI::App* command = app.add_subcommand("curve", "Write the series of runs as CSV: a row per record");
  command->add_option("STUDY", arguments.study, "Name or file of a study; default: every run");
  add_where_option(*command, arguments.where);
  command->add_option("--out", arguments.out, "File to write; default: standard output")->type_name("FILE");
  command->add_flag("--bands", arguments.bands,
                    "A row per case and 0.05 m of depth: n packings, mean tip resistance and its 95 % interval");
  add_store_option(*command, arguments.root);
  command->footer(
      "Examples:\n"
      "  runner curve tip_shape --out curves.csv\n"
      "  runner curve density --bands --out bands.csv\n"
      "  runner curve velocity --where \"pile.driving.constant.speed < 0.3\" | head");
  command->callback([&call] { call = [] { return curve(arguments); }; });
}

}  // namespace seapile::commands
