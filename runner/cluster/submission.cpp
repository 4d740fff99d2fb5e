#include "runner/cluster/submission.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "runner/store/durable.h"
#include "runner/store/run_folder.h"

namespace seapile::cluster {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFile = "submit.json";

std::optional<Submission> read_submission(const fs::path& folder) {
  std::ifstream in(folder / kFile);
  if (!in) return std::nullopt;
  try {
    const json object = json::parse(in);
    Submission submission;
    submission.folder = folder;
    object.at("study").get_to(submission.study);
    object.at("stamp").get_to(submission.stamp);
    for (const json& array : object.at("arrays")) {
      submission.arrays.push_back({array.at("job"), array.at("kind"), array.at("first"), array.at("tasks"),
                                   array.at("command").get<std::vector<std::string>>()});
    }
    for (const json& one : object.at("cases")) {
      submission.cases.push_back(
          {one.at("case"), one.at("name"), one.at("kind"), one.at("array"), one.at("task"), one.at("newest")});
      if (submission.cases.back().array >= submission.arrays.size()) return std::nullopt;
    }
    object.at("ingest").at("job").get_to(submission.ingest);
    object.at("ingest").at("command").get_to(submission.ingest_command);
    return submission;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<std::string> Submission::jobs() const {
  std::vector<std::string> ids;
  for (const SubmittedArray& array : arrays) ids.push_back(array.job);
  ids.push_back(ingest);
  std::erase(ids, "");
  return ids;
}

void write_submission(const Submission& submission) {
  json arrays = json::array(), cases = json::array();
  for (const SubmittedArray& array : submission.arrays) {
    arrays.push_back({{"job", array.job},
                      {"kind", array.kind},
                      {"first", array.first},
                      {"tasks", array.tasks},
                      {"command", array.command}});
  }
  for (const SubmittedCase& one : submission.cases) {
    cases.push_back({{"case", one.id},
                     {"name", one.name},
                     {"kind", one.kind},
                     {"array", one.array},
                     {"task", one.task},
                     {"newest", one.newest}});
  }
  const json object = {{"schema", "runner/submit/1"},
                       {"study", submission.study},
                       {"stamp", submission.stamp},
                       {"arrays", arrays},
                       {"ingest", {{"job", submission.ingest}, {"command", submission.ingest_command}}},
                       {"cases", cases}};
  store::write_text(submission.folder / kFile, object.dump(1) + "\n");
}

std::vector<Submission> read_submissions(const fs::path& root, const std::string& study) {
  std::vector<Submission> submissions;
  for (const fs::path& of_study : store::entries(root / "jobs")) {
    if (!study.empty() && of_study.filename() != study) continue;
    for (const fs::path& folder : store::entries(of_study)) {
      if (auto submission = read_submission(folder)) submissions.push_back(std::move(*submission));
    }
  }
  std::ranges::stable_sort(submissions, std::ranges::greater{}, &Submission::stamp);
  return submissions;
}

fs::path jobs_folder(const fs::path& root, const std::string& study) { return root / "jobs" / study; }

}  // namespace seapile::cluster
