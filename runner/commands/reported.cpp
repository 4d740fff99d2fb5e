#include "runner/commands/reported.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <set>

#include "runner/commands/case_states.h"
#include "runner/commands/checked.h"
#include "runner/commands/claimed.h"
#include "runner/commands/edges.h"
#include "runner/commands/packings.h"
#include "runner/execute/plan.h"
#include "runner/execute/provenance.h"
#include "runner/present/check_table.h"
#include "runner/present/claim_table.h"
#include "runner/present/report_charts.h"
#include "runner/present/report_tables.h"
#include "runner/present/summary.h"
#include "runner/store/durable.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using execute::Standing;
using present::ReportSection;
using present::ReportTable;
using present::Tone;

/// The study with the cases that it has come to: of a rule its packings, of an edge all values that were tried.
study::Study read_whole(const ReportRequest& request) {
  study::Study study = read_settled(request.study, request.options, request.root);
  if (!study.edge) return study;
  study::Options options = request.options;
  return searched(request.study, options, request.root);
}

std::string today() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(now));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

Tone tone_of(present::Finding finding) {
  switch (finding) {
    case present::Finding::ok:
      return Tone::good;
    case present::Finding::failed:
      return Tone::bad;
    default:
      return Tone::open;
  }
}

/// A claim that was refuted against nobody's expectation is a finding.
Tone tone_of(const present::Claimed& claim) {
  const present::ClaimVerdict verdict = present::judge(claim);
  if (present::standing(claim, verdict) == present::Standing::contrary) return Tone::bad;
  if (!verdict.decision || verdict.decision == present::Decision::underpowered) return Tone::open;
  if (!claim.expect.empty() || verdict.decision == present::Decision::confirmed) return Tone::good;
  return Tone::finding;
}

struct Verdicts {
  std::vector<present::Comparison> comparisons;
  std::vector<present::Claimed> claims;
};

Verdicts verdicts_of(const study::Study& study, const fs::path& root) {
  const CheckedCases cases(study, root);
  Verdicts verdicts{cases.with_published(), claimed(study, cases)};
  const auto accepted = study::read_accepted(study::accepted_path(study));
  if (accepted.empty()) return verdicts;  // A list of what was never accepted would say nothing of the results.
  for (auto& drift : cases.with_accepted(accepted)) verdicts.comparisons.push_back(std::move(drift));
  return verdicts;
}

/// How often a word of one tone occurs.
struct Tally {
  std::string word;
  Tone tone;
  std::size_t number = 0;
};

void count(std::vector<Tally>& tallies, const ReportTable& table) {
  const auto column = std::ranges::find(table.table.columns, table.toned) - table.table.columns.begin();
  for (std::size_t i = 0; i < table.tones.size(); ++i) {
    const auto& word = std::get<std::string>(table.table.rows[i][static_cast<std::size_t>(column)]);
    auto known =
        std::ranges::find_if(tallies, [&](const Tally& one) { return one.word == word && one.tone == table.tones[i]; });
    if (known == tallies.end()) known = tallies.insert(known, {word, table.tones[i]});
    ++known->number;
  }
}

/// "3 checks ok", "1 check FAILED".
void add_counts(present::Report& report, const char* what, const std::vector<Tally>& tallies) {
  for (const auto& [word, tone, number] : tallies)
    report.counts.push_back({fmt::format("{} {}{} {}", number, what, number == 1 ? "" : "s", word), tone});
}

void add_checks(present::Report& report, ReportSection& section, const Verdicts& verdicts, bool packings) {
  using present::Against;
  std::vector<Tally> checks, claims;
  for (const auto& [against, caption] : {std::pair(Against::published, "Checks against published values"),
                                         std::pair(Against::bounds, "Checks against bounds"),
                                         std::pair(Against::accepted, "Drift of our own accepted values")}) {
    const auto some = present::of_kind(verdicts.comparisons, against);
    if (some.empty()) continue;
    ReportTable table{caption, present::shown_checks(some, against), {}, "verdict"};
    for (const present::Comparison& one : some) table.tones.push_back(tone_of(present::judge(one).finding));
    const auto sources = present::sources_of(some);
    for (std::size_t i = 0; i < sources.size() && against == Against::published; ++i)
      table.notes.push_back(fmt::format("source {}: {}", i + 1, sources[i]));
    table.full = present::check_table(some);
    count(checks, table);
    section.blocks.emplace_back(std::move(table));
  }
  if (!verdicts.claims.empty()) {
    ReportTable table{"Claims", present::shown_claims(verdicts.claims), {}, "verdict"};
    for (const present::Claimed& claim : verdicts.claims) table.tones.push_back(tone_of(claim));
    table.notes = present::claim_sentences(verdicts.claims);
    table.full = present::with_claims(present::check_table({}), verdicts.claims);
    count(claims, table);
    section.blocks.emplace_back(std::move(table));
  }
  add_counts(report, "check", checks);
  add_counts(report, "claim", claims);
  auto remarks =
      lines_of(present::check_remark(verdicts.comparisons, packings) + present::claim_remark(verdicts.claims));
  if (verdicts.comparisons.empty() && verdicts.claims.empty())
    remarks = {"The study has no checks and no claims; its results are below."};
  if (!remarks.empty()) section.blocks.emplace_back(present::ReportText{std::move(remarks)});
}

/// Cases by their state, and those that are not completed with the reason.
void add_states(present::Report& report, ReportSection& section, const std::vector<CaseState>& states) {
  std::vector<present::Labels> labels;
  std::vector<const CaseState*> rest;
  for (const Standing standing : execute::kStandings) {
    const auto number =
        std::ranges::count_if(states, [&](const CaseState& one) { return one.at.standing == standing; });
    const bool always =
        standing == Standing::completed || standing == Standing::failed || standing == Standing::missing;
    if (number == 0 && !always) continue;
    report.counts.push_back({fmt::format("{} case{} {}", number, number == 1 ? "" : "s", execute::name(standing)),
                             number == 0 ? Tone::plain : tone(standing)});
  }
  for (const CaseState& one : states) {
    if (one.at.standing == Standing::completed) continue;
    rest.push_back(&one);
    labels.push_back(one.labels);
  }
  if (rest.empty()) return;
  ReportTable table{"Cases that are not completed", present::label_table(labels), {}, "state"};
  table.table.columns.insert(table.table.columns.begin(), "case");
  for (const char* name : {"state", "why"}) table.table.columns.emplace_back(name);
  table.table.units.insert(table.table.units.begin(), "");
  table.table.units.resize(table.table.columns.size());
  for (std::size_t i = 0; i < rest.size(); ++i) {
    auto& row = table.table.rows[i];
    const execute::CaseStanding& at = rest[i]->at;
    row.insert(row.begin(), execute::short_id(at.case_id));
    row.insert(row.end(), {execute::name(at.standing), at.reason});
    table.tones.push_back(tone(at.standing));
  }
  table.notes = {
      "A stale case has a result that was made with other numerics, another record or another bed than the "
      "study asks for today; tables and curves show it. `runner run` computes what the study lacks."};
  section.blocks.emplace_back(std::move(table));
}

std::vector<present::CaseResult> results_of(const study::Study& study, const std::vector<CaseState>& states) {
  std::vector<present::CaseResult> results;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const CaseState& one = states[i];
    const bool completed = one.at.completed;
    const std::string word =
        execute::name(one.at.standing == Standing::stale && completed ? Standing::completed : one.at.standing);
    results.push_back({one.at.case_id, one.labels, word, completed ? one.at.sealed_folder : fs::path(),
                       completed ? one.bed_folder : fs::path(), present::kind_of(study.cases[i].scene)});
  }
  return results;
}

ReportSection results_section(const std::vector<present::CaseResult>& results,
                              const std::vector<present::Comparison>& comparisons) {
  ReportSection section{"results", "Results", {}};
  present::Closing end = present::closing(results);
  section.blocks.emplace_back(
      ReportTable{"Headline numbers", std::move(end.table), std::move(end.means), "", {}, lines_of(end.remark)});
  for (present::ReportChart& chart : present::report_charts(results, comparisons))
    section.blocks.emplace_back(std::move(chart));
  return section;
}

/// Pictures below results/figures that are named after the study, NAME.svg or NAME_*.svg, and not after another study
/// with a longer name.
ReportSection pictures_section(const std::string& study, const fs::path& root) {
  ReportSection section{"figures", "Figures", {}};
  std::set<std::string> studies = {study};
  for (const fs::path& file : store::entries(root / "studies")) {
    const std::string stem = file.stem().string();
    studies.insert(stem.substr(0, stem.find_last_of('-')));
  }
  for (const fs::path& file : store::entries(root / "figures")) {
    if (file.extension() != ".svg" || !fs::is_regular_file(file)) continue;
    std::string owner = file.stem().string();
    while (!owner.empty() && !studies.contains(owner))
      owner.resize(owner.find_last_of('_') == owner.npos ? 0 : owner.find_last_of('_'));
    if (owner == study)
      section.blocks.emplace_back(present::ReportPicture{file.filename().string(), store::read_text(file)});
  }
  return section;
}

std::vector<present::ReportRun> runs_of(const std::vector<CaseState>& states) {
  std::vector<present::ReportRun> runs;
  for (const CaseState& one : states) {
    if (one.at.sealed_folder.empty()) continue;
    runs.push_back({one.labels, execute::name(one.at.standing), store::read_manifest(one.at.sealed_folder)});
  }
  return runs;
}

ReportSection cost_section(const std::vector<present::ReportRun>& runs, const std::vector<present::ReportRun>& beds) {
  constexpr std::size_t kMostBars = 60;
  ReportSection section{"cost", "Cost and stability", {}};
  section.blocks.emplace_back(present::cost_table(runs, beds));
  if (runs.size() > 1 && runs.size() <= kMostBars) section.blocks.emplace_back(present::cost_bars(runs));
  return section;
}

ReportSection parameters_section(const study::Study& study) {
  std::vector<present::ReportScene> scenes;
  const std::string record = fmt::format(R"({{"record": {}}})", study::to_json(study.record));
  for (const study::Case& one : study.cases) {
    const bool is_bed = one.id == one.bed_id;
    present::ReportScene scene{one.id, store::parameters(study::to_json(one.scene), is_bed ? "bed" : "drive")};
    if (!is_bed) std::ranges::move(store::parameters(record, ""), std::back_inserter(scene.parameters));
    scenes.push_back(std::move(scene));
  }
  ReportSection section{"parameters", "Parameters", {}};
  ReportTable apart = present::differing_parameters(scenes), common = present::common_parameters(scenes);
  if (apart.table.columns.size() > 1) section.blocks.emplace_back(std::move(apart));
  common.folded = true;
  section.blocks.emplace_back(std::move(common));
  return section;
}

ReportSection provenance_section(const study::Study& study, const ReportRequest& request, const std::string& date,
                                 std::vector<present::ReportRun> runs, const std::vector<present::ReportRun>& beds) {
  ReportSection section{"provenance", "Provenance", {}};
  section.blocks.emplace_back(ReportTable{"This report",
                                          {{"", "value"},
                                           {"", ""},
                                           {{"made", date},
                                            {"by", "seapile " + execute::version_line()},
                                            {"with", request.command},
                                            {"study file", study.file.string()},
                                            {"its SHA-256", study.file_sha256},
                                            {"store", request.root}}}});
  runs.insert(runs.end(), beds.begin(), beds.end());
  if (runs.empty()) return section;
  section.blocks.emplace_back(present::provenance_table(runs));
  ReportTable seals = present::seal_table(runs);
  seals.folded = true;
  section.blocks.emplace_back(std::move(seals));
  return section;
}

}  // namespace

std::optional<present::Report> reported(const ReportRequest& request) {
  const study::Study study = read_whole(request);
  const auto [states, beds] = study_states(study, request.root);
  const auto is_missing = [](const CaseState& one) { return one.at.standing == Standing::missing; };
  if (std::ranges::all_of(states, is_missing) && std::ranges::all_of(beds, is_missing)) return {};

  present::Report report{study.name, study.question, "", {}, {}};
  const std::string date = today();
  report.made = fmt::format("Made {} by seapile {}.", date, execute::version_line());
  const Verdicts verdicts = verdicts_of(study, request.root);
  const bool packings = std::ranges::any_of(study.cases, [](const study::Case& one) { return !is_water(one.scene); });

  ReportSection first{"verdicts", "Verdicts", {}};
  add_checks(report, first, verdicts, packings);
  if (study.edge)
    first.blocks.emplace_back(ReportTable{"Edges", present::edge_table(edge_searches(study, request.root))});
  add_states(report, first, states);
  report.sections.push_back(std::move(first));

  const std::vector<present::ReportRun> runs = runs_of(states), bed_runs = runs_of(beds);
  report.sections.push_back(results_section(results_of(study, states), verdicts.comparisons));
  if (!runs.empty()) report.sections.push_back(cost_section(runs, bed_runs));
  if (auto pictures = pictures_section(study.name, request.root); !pictures.blocks.empty())
    report.sections.push_back(std::move(pictures));
  ReportSection failures{"failures", "Failures", failure_logs(states)};
  std::ranges::move(failure_logs(beds), std::back_inserter(failures.blocks));
  if (!failures.blocks.empty()) report.sections.push_back(std::move(failures));
  report.sections.push_back(parameters_section(study));
  report.sections.push_back(provenance_section(study, request, date, runs, bed_runs));
  return report;
}

}  // namespace seapile::commands
