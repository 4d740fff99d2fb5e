#include "runner/cluster/engine_file.h"

#include "runner/study/field_reader.h"
#include "runner/study/json_value.h"
#include "runner/study/study.h"
#include "runner/study/text_file.h"

namespace seapile::cluster {
namespace {

using study::Value;

void read_strings(const Value& value, std::vector<std::string>& member, base::Problems& problems) {
  if (value.kind != Value::Kind::array) {
    problems.push_back({study::pointer(value.place), "is " + study::kind_name(value), "a list of strings", ""});
    return;
  }
  for (const Value& item : value.items) {
    if (item.kind == Value::Kind::unusable) continue;  // reported where it was read, as are texts of several lines
    std::string text;
    study::read_string(item, text, problems);
    member.push_back(std::move(text));
  }
}

}  // namespace

Engine read_engine(const std::filesystem::path& file) {
  std::string trouble;
  const auto text = study::read_text(file, study::kMostBytes, trouble);
  if (!text) throw study::BadInput(file.string(), {{"", trouble, "a JSON file", ""}});
  base::Problems problems;
  const Value root = study::read_json(*text, "", problems);
  Engine engine;
  if (root.kind != Value::Kind::unusable && study::is_object(root, problems)) {
    study::report_unknown_keys(root, {"engine", "account", "partition", "qos", "modules", "setup", "sbatch"}, problems);
    const auto read_text = [&](const char* key, std::string& member) {
      if (const Value* value = root.find(key)) study::read_string(*value, member, problems);
    };
    const auto read_list = [&](const char* key, std::vector<std::string>& member) {
      if (const Value* value = root.find(key)) read_strings(*value, member, problems);
    };
    read_text("engine", engine.engine);
    read_text("account", engine.account);
    read_text("partition", engine.partition);
    read_text("qos", engine.qos);
    read_list("modules", engine.modules);
    read_list("setup", engine.setup);
    read_list("sbatch", engine.sbatch);
    if (engine.engine != "slurm") problems.push_back({"/engine", "is no engine", "slurm", "slurm"});
  }
  if (!problems.empty()) throw study::BadInput(file.string(), std::move(problems));
  return engine;
}

std::vector<std::string> sbatch_words(const Engine& engine) {
  std::vector<std::string> words;
  if (!engine.account.empty()) words.push_back("--account=" + engine.account);
  if (!engine.partition.empty()) words.push_back("--partition=" + engine.partition);
  if (!engine.qos.empty()) words.push_back("--qos=" + engine.qos);
  words.insert(words.end(), engine.sbatch.begin(), engine.sbatch.end());
  return words;
}

}  // namespace seapile::cluster
