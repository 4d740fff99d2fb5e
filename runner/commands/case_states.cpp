#include "runner/commands/case_states.h"

#include <fmt/format.h>

#include <map>

#include "runner/execute/campaign.h"
#include "runner/store/run_folder.h"

namespace seapile::commands {
namespace {

using execute::Standing;

constexpr std::size_t kLogLines = 15;

}  // namespace

present::Tone tone(Standing standing) {
  if (standing == Standing::completed) return present::Tone::good;
  const bool bad = standing == Standing::failed || standing == Standing::diverged;
  return bad ? present::Tone::bad : present::Tone::open;
}

StudyStates study_states(const study::Study& study, const std::filesystem::path& root) {
  execute::CampaignOptions options;
  options.root = root.string();
  const execute::Campaign campaign(study, options);
  std::map<std::string, execute::CaseStanding> at;
  for (execute::CaseStanding& one : execute::standings(campaign.plan(), root)) at.emplace(one.case_id, std::move(one));

  StudyStates states;
  for (const study::Case& one : study.cases) {
    const auto bed = one.bed_id.empty() ? std::filesystem::path() : store::newest_run(root, one.bed_id);
    states.cases.push_back({std::move(at.extract(one.id).mapped()), one.labels, bed});
  }
  for (auto& [id, standing] : at) states.beds.push_back({std::move(standing), {}, {}});
  return states;
}

std::vector<present::ReportBlock> failure_logs(const std::vector<CaseState>& states) {
  std::vector<present::ReportBlock> blocks;
  for (const CaseState& one : states) {
    const Standing standing = one.at.standing;
    if (standing != Standing::failed && standing != Standing::diverged && standing != Standing::interrupted) continue;
    const std::string labels = execute::label_line(one.labels), id = execute::short_id(one.at.case_id);
    blocks.emplace_back(
        present::ReportLog{labels.empty() ? "case " + id : fmt::format("{} (case {})", labels, id),
                           execute::name(standing), one.at.reason, (one.at.run_folder / "log.txt").string(),
                           fmt::format("{}", fmt::join(execute::last_log_lines(one.at.run_folder, kLogLines), "\n"))});
  }
  return blocks;
}

}  // namespace seapile::commands
