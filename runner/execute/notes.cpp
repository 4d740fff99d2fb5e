#include "runner/execute/notes.h"

#include <unistd.h>

#include <array>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kProgress = "progress.json";
constexpr const char* kFailure = "failure.json";

/// Whole or not at all, but not forced to the disk: after a power cut a note is worth nothing.
void write(const fs::path& file, const json& note) noexcept {
  try {
    const fs::path temporary = file.string() + ".new";
    {
      std::ofstream out(temporary);
      out << note.dump(-1, ' ', false, json::error_handler_t::replace) << "\n";
      if (!out.flush()) return;
    }
    fs::rename(temporary, file);
  } catch (const std::exception&) {
  }
}

std::optional<json> read(const fs::path& file) {
  std::ifstream in(file);
  if (!in) return {};
  json note = json::parse(in, nullptr, false);
  if (!note.is_object()) return {};
  return note;
}

std::string host_name() {
  std::array<char, 256> name = {};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

void write_progress(const fs::path& run_folder, const RunProgress& progress) noexcept {
  write(run_folder / kProgress, {{"schema", "runner/progress/1"},
                                 {"fraction", progress.fraction},
                                 {"start_fraction", progress.start_fraction},
                                 {"elapsed", progress.elapsed},
                                 {"threads", progress.threads},
                                 {"host", host_name()}});
}

std::optional<RunProgress> read_progress(const fs::path& run_folder) {
  const auto note = read(run_folder / kProgress);
  if (!note) return {};
  return RunProgress{note->value("fraction", 0.0), note->value("start_fraction", 0.0), note->value("elapsed", 0.0),
                     note->value("threads", 1), note->value("host", "")};
}

void write_failure(const fs::path& run_folder, const Failure& failure) noexcept {
  write(run_folder / kFailure,
        {{"schema", "runner/failure/1"}, {"kind", failure.kind}, {"sentence", failure.sentence}});
}

std::optional<Failure> read_failure(const fs::path& run_folder) {
  const auto note = read(run_folder / kFailure);
  if (!note) return {};
  return Failure{note->value("kind", ""), note->value("sentence", "")};
}

void remove_notes(const fs::path& run_folder) noexcept {
  std::error_code ignored;
  fs::remove(run_folder / kProgress, ignored);
  fs::remove(run_folder / kFailure, ignored);
}

std::vector<std::string> last_log_lines(const fs::path& run_folder, std::size_t count) {
  std::ifstream in(run_folder / "log.txt");
  std::deque<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(std::move(line));
    if (lines.size() > count) lines.pop_front();
  }
  return {lines.begin(), lines.end()};
}

}  // namespace seapile::execute
