#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "runner/commands/command.h"
#include "runner/commands/templates.h"
#include "runner/commands/words.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

// What may follow is asked of the program itself at every press of the key, so that the script never falls behind it.
// Words are handed over and come back one a line; what is no word of the program is left to the shell's own files.
constexpr const char* kScript = R"(# Completion of bash for runner, Seapile's program.
_runner() {
  local word=${COMP_WORDS[COMP_CWORD]} line
  COMPREPLY=()
  while IFS= read -r line; do
    COMPREPLY+=("$line")
  done < <("${COMP_WORDS[0]}" complete-words "$COMP_CWORD" -- "${COMP_WORDS[@]:1}" 2> /dev/null)
  if [[ ${#COMPREPLY[@]} -eq 0 && $word != -* ]]; then
    compopt -o filenames 2> /dev/null
    while IFS= read -r line; do
      COMPREPLY+=("$line")
    done < <(compgen -f -- "$word")
  elif [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == */ ]]; then
    compopt -o nospace 2> /dev/null
  fi
}
complete -F _runner runner
)";

using Words = std::vector<std::string>;

/// The choices that an option's or a position's help lists: "table|csv|json".
Words choices(const CLI::Option& option) {
  Words names;
  std::istringstream in(option.get_type_name());
  for (std::string name; std::getline(in, name, '|');) names.push_back(name);
  const auto is_name = [](const std::string& name) {
    return !name.empty() && std::ranges::none_of(name, [](unsigned char c) { return std::isupper(c) != 0; });
  };
  if (names.size() < 2) return {};
  std::erase_if(names, [&](const std::string& name) { return !is_name(name); });
  return names;
}

/// Study files, and folders on the way to them, that begin like `word`.
Words study_files(const std::string& word) {
  namespace fs = std::filesystem;
  const std::string folder = word.substr(0, word.rfind('/') + 1);
  Words names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::string name = folder + entry.path().filename().string();
    if (entry.path().filename().string().starts_with(".")) continue;
    if (entry.is_directory(error)) names.push_back(name + "/");
    if (entry.path().extension() == ".json") names.push_back(name);
  }
  return names;
}

/// Where the words say that results are.
std::string store_of(const Words& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--store" && i + 1 < words.size()) return words[i + 1];
    if (words[i].starts_with("--store=")) return words[i].substr(8);
  }
  return "results";
}

/// Names of studies, or ids of cases, that the catalogue knows; none where there is no catalogue to be read.
Words known(const std::string& root, bool studies) {
  try {
    const auto catalogue = store::Catalogue::open_read_only(root);
    if (studies) return catalogue.studies();
    Words ids;
    for (const auto& row : catalogue.query("", {}, {"outcome"}).rows) ids.push_back(std::get<std::string>(row[0]));
    return ids;
  } catch (const std::exception&) {
    return {};
  }
}

/// What may stand where `option` is due.
Words values(const CLI::Option& option, const Words& before, const std::string& word) {
  if (Words names = choices(option); !names.empty()) return names;
  const std::string name = option.get_name(true);
  if (option.check_lname("from") && option.get_type_name() == "STUDY") return shipped_names();
  if (name.starts_with("ID") || name.starts_with("RUN") || name.starts_with("A") || name.starts_with("B"))
    return known(store_of(before), false);
  if (!name.starts_with("STUDY")) return {};
  Words names = study_files(word);
  // A command that needs a file takes no name.
  if (option.get_description().find("Name") != std::string::npos) {
    for (const std::string& study : known(store_of(before), true)) names.push_back(study);
  }
  return names;
}

/// The option whose value the next word is; null when it is none's.
const CLI::Option* waiting(const CLI::App& command, const Words& words) {
  if (words.empty() || !words.back().starts_with("-")) return nullptr;
  const CLI::Option* option = command.get_option_no_throw(words.back());
  return option != nullptr && option->get_items_expected_max() > 0 ? option : nullptr;
}

/// The position that the next word has, the last one again where it takes several.
const CLI::Option* position(const CLI::App& command, const Words& words) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_value = i > 0 && waiting(command, {words.begin(), words.begin() + static_cast<std::ptrdiff_t>(i)});
    if (!words[i].starts_with("-") && !is_value) ++count;
  }
  const auto positions = command.get_options([](const CLI::Option* option) { return option->get_positional(); });
  if (positions.empty()) return nullptr;
  if (count < positions.size()) return positions[count];
  return positions.back()->get_items_expected_max() > 1 ? positions.back() : nullptr;
}

/// Every word that may stand behind `before`, whatever it begins like.
Words candidates(const CLI::App& app, const Words& before, const std::string& word) {
  Words names;
  const auto commands = commands_of(app);
  const auto named = [&](const CLI::App* command) { return !before.empty() && command->get_name() == before[0]; };
  const auto found = std::ranges::find_if(commands, named);
  const bool is_study = !before.empty() && before[0].ends_with(".json");
  if (before.empty()) {
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    for (const std::string& option : long_options(app)) names.push_back(option);
    for (const std::string& file : study_files(word)) names.push_back(file);
    return names;
  }
  if (found == commands.end() && !is_study) return {};
  const CLI::App& command = is_study ? *app.get_subcommand("run") : **found;
  const Words inside(before.begin() + (is_study ? 0 : 1), before.end());
  if (const CLI::Option* option = waiting(command, inside)) return values(*option, before, word);
  if (word.starts_with("-")) {
    names = long_options(command);
    names.emplace_back("--no-color");
    return names;
  }
  const CLI::Option* option = position(command, inside);
  return option == nullptr ? Words{} : values(*option, before, word);
}

struct CompletionArguments {
  std::string shell;
  std::size_t place = 0;
  Words words;
};

/// Prints what the word at `place` may become. Bash takes "--option=" and its value apart, into three words.
int complete(const CLI::App& app, const CompletionArguments& arguments) {
  Words before = arguments.words;
  before.resize(std::min(before.size(), arguments.place == 0 ? 0 : arguments.place - 1));
  std::string word = arguments.place > 0 && arguments.place <= arguments.words.size()
                         ? arguments.words[arguments.place - 1]
                         : std::string();
  std::erase(before, "=");
  if (word == "=") word.clear();
  std::set<std::string> sorted;
  for (const std::string& candidate : candidates(app, before, word)) {
    if (candidate.starts_with(word)) sorted.insert(candidate);
  }
  for (const std::string& candidate : sorted) fmt::print("{}\n", candidate);
  return execute::kDone;
}

}  // namespace

void add_completion(CLI::App& app, Call& call) {
  static CompletionArguments arguments;
  CLI::App* command = app.add_subcommand("completion", "Print a script with which a shell completes commands");
  one_of(command->add_option("SHELL", arguments.shell, "The shell"), {"bash"})->required();
  command->footer(
      "An installed program brings the script along, below share/bash-completion/completions.\n\n"
      "Examples:\n"
      "  source <(runner completion bash)\n"
      "  runner completion bash > ~/.local/share/bash-completion/completions/runner");
  command->callback([&call] {
    call = [] {
      fmt::print("{}", kScript);
      return execute::kDone;
    };
  });

  // Asked by the script; no command of a user's.
  CLI::App* words = app.add_subcommand("complete-words", "The words that may stand at a place")->group("");
  words->add_option("PLACE", arguments.place)->required();
  words->add_option("WORDS", arguments.words);
  words->callback([&app, &call] { call = [&app] { return complete(app, arguments); }; });
}

}  // namespace seapile::commands
