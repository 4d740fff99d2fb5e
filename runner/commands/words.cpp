#include "runner/commands/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "runner/study/nearest.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

std::string did_you_mean(const std::string& nearest, const std::string& otherwise) {
  return nearest.empty() ? otherwise : fmt::format("; did you mean \"{}\"?", nearest);
}

bool looks_like_a_file(const std::string& word) {
  return word.ends_with(".json") || word.find('/') != std::string::npos;
}

/// The study file that a word probably means, by its name, in the folder that the word names or in `studies`: the one
/// of the very same name, or where `near` is asked for the nearest; "" when there is none.
std::string study_file(const std::string& word, bool near) {
  const fs::path asked = word;
  std::vector<fs::path> files;
  std::vector<std::string> names;
  for (const fs::path& folder : {asked.parent_path(), fs::path("studies")}) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
      if (entry.path().extension() == ".json") files.push_back(folder / entry.path().filename());
    }
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) names.push_back(file.stem().string());
  const std::string name = near ? study::nearest(asked.stem().string(), names) : asked.stem().string();
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? "" : files[static_cast<std::size_t>(found - names.begin())].string();
}

const CLI::App* command_named(const CLI::App& app, const std::string& name) {
  const auto all = app.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; });
  return all.empty() ? nullptr : all.front();
}

/// CLI11 takes for an option whatever begins like one, also where a value is due.
bool is_long_option(const std::string& word) {
  return word.size() > 2 && word.starts_with("--") && std::isalpha(static_cast<unsigned char>(word[2])) != 0;
}

std::string unknown_option(const std::vector<std::string>& words, const CLI::App& command) {
  for (const std::string& word : words) {
    if (word == "--") break;
    if (!is_long_option(word)) continue;
    const std::string name = word.substr(0, word.find('='));
    if (command.get_option_no_throw(name) != nullptr) continue;
    const std::string place = command.get_parent() == nullptr ? "" : command.get_name() + " ";
    return fmt::format(
        "there is no option {}{}", name,
        did_you_mean(study::nearest(name, long_options(command)), fmt::format("; `runner {}--help` names all", place)));
  }
  return "";
}

}  // namespace

std::vector<std::string> words_of(int count, char** arguments, const CLI::App& app) {
  std::vector<std::string> words(arguments + 1, arguments + count);
  if (const auto without = std::ranges::find(words, "--no-color"); without != words.end()) {
    ::setenv("NO_COLOR", "1", 1);
    words.erase(without);
  }
  if (words.empty() || words[0].starts_with("-") || command_named(app, words[0]) != nullptr) return words;
  if (fs::is_regular_file(words[0])) words.insert(words.begin(), "run");
  return words;
}

std::string objection(const std::vector<std::string>& words, const CLI::App& app) {
  if (words.empty()) return "";
  if (words[0].starts_with("-")) return unknown_option({words[0]}, app);
  if (const CLI::App* command = command_named(app, words[0]))
    return unknown_option({words.begin() + 1, words.end()}, *command);
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  const bool is_file = looks_like_a_file(words[0]);
  std::string near = study_file(words[0], false);
  if (near.empty()) near = is_file ? study_file(words[0], true) : study::nearest(words[0], names);
  if (is_file) return fmt::format("there is no file {}{}", words[0], did_you_mean(near, ""));
  return fmt::format("there is no command \"{}\"{}", words[0],
                     did_you_mean(near, fmt::format("; there are {}", fmt::join(names, ", "))));
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<std::string> long_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

}  // namespace seapile::commands
