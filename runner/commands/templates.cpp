#include "runner/commands/templates.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runner/store/durable.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kIndent = 2;

/// The text with another value behind the first `"key": "..."`; unchanged when there is none.
std::string with_value(std::string text, const std::string& key, const std::string& value) {
  const std::string before = Json(key).dump();
  const auto at = text.find(before);
  if (at == std::string::npos) return text;
  const auto begin = text.find('"', at + before.size());
  if (begin == std::string::npos) return text;
  auto end = begin + 1;
  while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
  if (end >= text.size()) return text;
  return text.replace(begin, end + 1 - begin, Json(value).dump());
}

/// Takes out the checks whose file is not there for a study in `folder`.
std::vector<std::string> leave_out_checks(Json& study, const fs::path& folder) {
  std::vector<std::string> sentences;
  if (!study.contains("checks")) return sentences;
  Json kept = Json::array();
  for (const Json& check : study.at("checks")) {
    const auto file = check.find("reference");
    if (file == check.end() || fs::is_regular_file(folder / file->get<std::string>())) {
      kept.push_back(check);
    } else {
      sentences.push_back(fmt::format("a check is left out: its published values are in {}, which is not beside it",
                                      file->get<std::string>()));
    }
  }
  if (kept.empty()) {
    study.erase("checks");
  } else {
    study["checks"] = std::move(kept);
  }
  return sentences;
}

}  // namespace

fs::path shipped_studies() {
  std::error_code error;
  const fs::path bin = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {bin / "../share/seapile/studies", bin / "../../../studies"}) {
    if (fs::is_directory(folder, error)) return folder.lexically_normal();
  }
  return {};
}

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  const fs::path folder = shipped_studies();
  if (folder.empty()) return names;
  for (const fs::path& file : store::entries(folder)) {
    if (file.extension() == ".json") names.push_back(file.stem().string());
  }
  std::ranges::sort(names);
  return names;
}

NewStudy derived(const fs::path& from, const std::string& name, const std::string& question, const fs::path& folder) {
  const std::string text = store::read_text(from);
  Json study = Json::parse(text);
  const std::string asked = !question.empty() ? question
                                              : fmt::format("To be asked. It began as {}: {}", from.stem().string(),
                                                            study.value("question", std::string("no question")));
  study["study"] = name;
  study["question"] = asked;
  NewStudy result;
  result.left_out = leave_out_checks(study, folder);
  // The layout is kept where the text can be changed in place; else the study is laid out anew.
  result.text = with_value(with_value(text, "study", name), "question", asked);
  if (Json::parse(result.text, nullptr, false) != study) result.text = study.dump(kIndent) + "\n";
  return result;
}

std::string smallest_study(const std::string& name, const std::string& question) {
  return fmt::format(
      R"({{
  "study": "{}",
  "question": {},
  "base": {{
    "bed": {{
      "domain": {{"width": "0.8 m", "height": "1.5 m"}},
      "grains": {{"count": 300, "radius": {{"min": "0.02 m", "max": "0.03 m"}}}}
    }},
    "pile": {{"radius": "0.05 m", "depth": "0.3 m", "driving": {{"constant": {{"speed": "0.2 m/s"}}}}}},
    "fluid": null
  }},
  "axes": {{"pile.tip": ["conical", "flat"]}},
  "replicates": {{"seeds": 3}},
  "record": {{"frames": ["0 m", "0.15 m", "0.3 m"]}}
}}
)",
      name, Json(question.empty() ? "How does the tip change the resistance of a small dry bed?" : question).dump());
}

}  // namespace seapile::commands
