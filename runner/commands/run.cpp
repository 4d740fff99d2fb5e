#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runner/commands/command.h"
#include "runner/commands/edges.h"
#include "runner/commands/packings.h"
#include "runner/commands/repeat.h"
#include "runner/execute/campaign.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/tint.h"
#include "runner/present/edge_figure.h"
#include "runner/present/run_text.h"
#include "runner/present/summary.h"
#include "runner/store/catalogue.h"
#include "runner/study/study.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  std::string study, bundle;
  study::Options options;
  execute::CampaignOptions campaign;
  bool dry_run = false;
};

/// A picture for the kinds of case that have one: of drives STUDY.svg, of jets STUDY_surface.svg.
void draw(const study::Study& study, const std::vector<present::CaseResult>& results, const fs::path& root) {
  const auto draw_as = [&](const std::string& name, const auto& figure) {
    const fs::path svg = root / "figures" / (name + ".svg");
    try {
      present::draw(figure, svg);
      fmt::print("\n{}\n", svg.string());
    } catch (const store::StoreError& error) {
      fmt::print(stderr, "{}\n", error.what());  // The results stand without their picture.
    }
  };
  const auto resistances = present::resistance_figure(study.question, results);
  if (!resistances.groups.empty()) draw_as(study.name, resistances);
  const auto surfaces = present::surface_figure(study.question, results);
  if (!surfaces.curves.empty()) draw_as(study.name + "_surface", surfaces);
}

void show(const study::Study& study, const execute::Campaign& campaign, const fs::path& root) {
  std::vector<present::CaseResult> results;
  const std::vector<execute::CaseOutcome> outcomes = campaign.outcomes();
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const execute::CaseOutcome& outcome = outcomes[i];
    results.push_back({outcome.case_id, outcome.labels, outcome.word, outcome.run_folder, outcome.bed_folder,
                       present::kind_of(study.cases[i].scene)});
  }
  fmt::print("{}", execute::tinted(present::closing_text(results), stdout));
  draw(study, results, root);
}

/// The packings of the next round, where the study's rule asks for one; says what it decided, in one line.
std::optional<std::int64_t> more_packings(const study::Study& study, const fs::path& root) {
  if (!study.packing_rule) return {};
  const auto round = packing_round(study, root);
  if (!round) return {};
  fmt::print(stderr, "{}\n", present::round_text(*round, packings_asked(*study.packing_rule)));
  if (round->next == round->packings) return {};
  return static_cast<std::int64_t>(round->next);
}

/// A map of the edges, where an axis is a number: STUDY_edge.svg.
void draw_edges(const study::Study& study, const std::vector<present::EdgeSearch>& searches, const fs::path& root) {
  const fs::path svg = root / "figures" / (study.name + "_edge.svg");
  try {
    if (present::draw(study.question, searches, svg)) fmt::print("\n{}\n", svg.string());
  } catch (const store::StoreError& error) {
    fmt::print(stderr, "{}\n", error.what());  // The results stand without their picture.
  }
}

/// Which parts numbers or the study decided about, and what a scene is too small for.
void say_what_is_built(const study::Study& study) {
  std::vector<scene::SceneSpec> scenes;
  for (const study::Case& one : study.cases) scenes.push_back(one.scene);
  for (const std::string& line : present::decision_lines(scenes)) fmt::print(stderr, "{}\n", line);
  for (const std::string& line : present::warning_lines(scenes)) fmt::print(stderr, "{}\n", line);
}

/// Both ends of an edge, then what the results ask for. A run that diverges is a result here and is not tried again;
/// all that was tried stays in the catalogue under the study.
int run_edge(const RunArguments& arguments) {
  const fs::path root = arguments.campaign.root;
  study::Options options = arguments.options;
  for (;;) {
    const study::Study study = searched(arguments.study, options, root);
    const auto searches = edge_searches(study, root);
    if (const auto untried = untried_probes(study, searches); !untried.empty()) {
      study::Options round = arguments.options;
      round.probes = untried;
      const study::Study to_run = study::read(arguments.study, round);
      execute::Campaign campaign(to_run, arguments.campaign);
      if (const auto objection = execute::objection(campaign.sharing()); !objection.empty())
        throw UsageError(objection);
      for (const std::string& line : execute::describe(campaign.plan()))
        fmt::print(stderr, "{}\n", execute::tinted(line, stderr));
      say_what_is_built(to_run);
      if (arguments.dry_run) return execute::kDone;
      const int code = campaign.carry_out();
      if (code != execute::kDone && code != execute::kSomeCasesFailed) return code;
      if (untried_probes(study, edge_searches(study, root)) == untried) return code;  // they failed to run at all
      continue;
    }
    if (!arguments.dry_run) store::Catalogue::open(root).put(execute::entry_of(study));
    fmt::print("{}", present::text(present::edge_table(searches), present::Format::table));
    if (!arguments.dry_run) draw_edges(study, searches, root);
    return execute::kDone;
  }
}

/// Round after round while the study's rule asks for more packings; a study without one is one round. A round whose
/// results are all there is only read, so that the same command finds its way through what it has done to where it
/// ended.
int run(const RunArguments& arguments) {
  const fs::path root = arguments.campaign.root;
  study::Options options = arguments.options;
  std::string text;  // of the study: its SHA-256
  for (;;) {
    const study::Study study = study::read(arguments.study, options);
    if (study.edge) return run_edge(arguments);
    if (!text.empty() && text != study.file_sha256)
      throw UsageError(arguments.study + " was changed while it ran; give the command again");
    text = study.file_sha256;
    execute::Campaign campaign(study, arguments.campaign);
    if (const auto objection = execute::objection(campaign.sharing()); !objection.empty()) throw UsageError(objection);
    const bool idle = std::ranges::all_of(campaign.plan().tasks, [](const execute::Task& task) {
      return task.decision.action == execute::Action::fresh;
    });
    if (idle) {
      options.packings = more_packings(study, root);
      if (options.packings) continue;
    }
    for (const std::string& line : execute::describe(campaign.plan()))
      fmt::print(stderr, "{}\n", execute::tinted(line, stderr));
    if (arguments.dry_run || !idle) say_what_is_built(study);
    if (arguments.dry_run) return execute::kDone;
    if (idle) fmt::print(stderr, "nothing to run: every case is fresh\n");

    const int code = campaign.carry_out();
    if (!idle && code == execute::kDone) {
      options.packings = more_packings(study, root);
      if (options.packings) continue;
    } else if (!idle && study.packing_rule) {
      fmt::print(stderr, "this round is not done: no more packings are asked for\n");
    }
    show(study, campaign, root);
    return code;
  }
}

}  // namespace

void add_run(CLI::App& app, Call& call) {
  static RunArguments arguments;
  execute::CampaignOptions& campaign = arguments.campaign;
  CLI::App* command = app.add_subcommand("run", "Run what a study lacks, and show its results; or repeat a run");
  CLI::Option* study = command->add_option("STUDY", arguments.study, "Study file");
  CLI::Option* from = command->add_option("--from", arguments.bundle, "Repeat the run of a bundle instead of a study")
                          ->type_name("FILE.tar");
  add_study_options(*command, arguments.options);
  add_sharing_options(*command, campaign.sharing);
  command->add_option("--checkpoint", campaign.checkpoint_every, "Wall time between two checkpoints of a case [s]")
      ->capture_default_str()
      ->check(from_up(0));
  add_store_option(*command, campaign.root);
  command->add_flag("--dry-run", arguments.dry_run, "Say what would be run, and why; write nothing");
  command->footer(
      "--from: the bed and the case of a bundle (runner export --bundle) are computed from nothing by this program, in "
      "a\n"
      "store of their own, \"again\" unless --store names one, and compared with what was bundled. Exit code 0: the "
      "final\n"
      "states are the same to the last bit; 3: they are not, with the distances and what is known to differ.\n\n"
      "Examples:\n"
      "  runner run studies/tip_shape.json --dry-run\n"
      "  runner run studies/velocity.json --seeds 5 --jobs 2\n"
      "  runner run studies/tip_shape.json --set \"pile.driving.constant.speed=0.2 m/s\"\n"
      "  runner run --from drive.tar                       a run that somebody has exported");
  std::vector<const CLI::Option*> of_studies = {study};
  for (const char* name : {"--set", "--seeds", "--fidelity"}) of_studies.push_back(command->get_option(name));
  command->callback([&call, of_studies, from, store = command->get_option("--store")] {
    const bool with_study = std::ranges::any_of(of_studies, [](const CLI::Option* one) { return one->count() > 0; });
    if (from->count() > 0 && with_study)
      throw CLI::ExcludesError("--from", "STUDY, --set, --seeds or --fidelity: the run is repeated as it was");
    if (from->count() + of_studies.front()->count() == 0) throw CLI::RequiredError("STUDY or --from");
    if (from->count() > 0 && store->count() == 0) arguments.campaign.root = kRepetitionRoot;
    call = [repeats = from->count() > 0] {
      return repeats ? repeat(arguments.bundle, arguments.campaign, arguments.dry_run) : run(arguments);
    };
  });
}

}  // namespace seapile::commands
