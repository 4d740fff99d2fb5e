#include "runner/study/frozen_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runner/study/csv.h"
#include "runner/study/sha256.h"
#include "runner/study/study.h"
#include "runner/study/text_file.h"

namespace seapile::study {
namespace {

constexpr std::array kHead = {"case", "seal", "state", "cpu[s]", "memory[MB]", "steps"};
constexpr std::array kNotes = {"study", "made with", "own error", "sha256"};
constexpr const char* kForm = "what `runner trade STUDY --freeze` wrote";

/// The notes above the rows, by the order of kNotes, and where the rows begin.
struct Notes {
  std::array<std::string, kNotes.size()> text;
  std::size_t end = 0;
};
std::optional<Notes> notes_of(const std::string& bytes) {
  Notes notes;
  for (std::size_t i = 0; i < kNotes.size(); ++i) {
    const std::string start = fmt::format("# {}: ", kNotes[i]);
    const std::size_t end = bytes.find('\n', notes.end);
    if (end == std::string::npos || bytes.compare(notes.end, start.size(), start) != 0) return {};
    notes.text[i] = bytes.substr(notes.end + start.size(), end - notes.end - start.size());
    notes.end = end + 1;
  }
  return notes;
}

/// `variant` of "NAME, of variant "VARIANT"".
std::string variant_in(const std::string& note) {
  const auto first = note.find('"'), last = note.rfind('"');
  return first == last ? "" : note.substr(first + 1, last - first - 1);
}

void read_row(const CsvRecord& record, const std::vector<std::string>& columns, Frozen& frozen,
              LineProblems& problems) {
  if (record.fields.size() != columns.size()) {
    problems.refuse(record.line, fmt::format("has {} fields", record.fields.size()), fmt::format("{}", columns.size()));
    return;
  }
  FrozenRun run{record.fields[0], record.fields[1], record.fields[2], 0, 0, 0, {}};
  std::vector<double> numbers;
  for (std::size_t c = 3; c < columns.size(); ++c) {
    const auto number = csv_number<double>(record.fields[c]);
    if (!number) {
      problems.refuse(record.line, fmt::format("{} \"{}\" is no finite number", columns[c], record.fields[c]),
                      "a number");
      return;
    }
    numbers.push_back(*number);
    if (c >= kHead.size()) run.metrics.emplace_back(columns[c], *number);
  }
  run.cpu_seconds = numbers[0];
  run.peak_memory_mb = numbers[1];
  run.steps = numbers[2];
  frozen.runs.push_back(std::move(run));
}

std::string rows_text(const Frozen& frozen) {
  std::vector<std::string> columns(kHead.begin(), kHead.end());
  if (!frozen.runs.empty())
    for (const auto& [name, value] : frozen.runs.front().metrics) columns.push_back(name);
  std::string text = csv_line(columns);
  for (const FrozenRun& run : frozen.runs) {
    std::vector<std::string> fields{run.case_id, run.seal, run.state_hash};
    for (const double value : {run.cpu_seconds, run.peak_memory_mb, run.steps})
      fields.push_back(fmt::format("{}", value));
    for (const auto& [name, value] : run.metrics) fields.push_back(fmt::format("{}", value));
    text += csv_line(fields);
  }
  return text;
}

}  // namespace

std::filesystem::path frozen_path(const std::filesystem::path& study_file, const std::string& name) {
  return study_file.parent_path() / "frozen" / (name + ".csv");
}

std::string frozen_text(const std::string& study, const Frozen& frozen) {
  const std::string rows = rows_text(frozen);
  return fmt::format("# study: {}, of variant \"{}\"\n# made with: {}\n# own error: {}\n# sha256: {}\n{}", study,
                     frozen.variant, frozen.made_with, frozen.own_error, sha256(rows), rows);
}

std::optional<Frozen> read_frozen(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return {};
  std::string trouble;
  const auto bytes = read_text(file, kMostBytes, trouble);
  if (!bytes) throw BadInput(file.string(), {{"", trouble, kForm, ""}});
  const auto notes = notes_of(*bytes);
  if (!notes) throw BadInput(file.string(), {{"", "does not begin with its four notes", kForm, ""}});
  const std::string rows = bytes->substr(notes->end);
  if (sha256(rows) != notes->text[3])
    throw BadInput(file.string(), {{"", "was changed since it was frozen: its rows have another sha256", kForm, ""}});

  base::Problems found;
  LineProblems problems(found);
  const auto records = read_csv(rows, kNotes.size() + 1, problems);
  Frozen frozen{variant_in(notes->text[0]), notes->text[1], notes->text[2], {}};
  if (records.empty() || records.front().fields.size() <= kHead.size() ||
      !std::equal(kHead.begin(), kHead.end(), records.front().fields.begin()))
    problems.refuse(kNotes.size() + 1, "is not the header", kForm);
  else
    for (std::size_t r = 1; r < records.size(); ++r) read_row(records[r], records.front().fields, frozen, problems);
  problems.finish();
  if (!found.empty()) throw BadInput(file.string(), std::move(found));
  return frozen;
}

const FrozenRun* find_frozen(const Frozen& frozen, const std::string& case_id) {
  const auto run = std::ranges::find(frozen.runs, case_id, &FrozenRun::case_id);
  return run == frozen.runs.end() ? nullptr : &*run;
}

}  // namespace seapile::study
