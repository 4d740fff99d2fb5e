// The words of the command line before they are parsed: `runner STUDY` means `runner run STUDY`, and a command, an option
// or a file that does not exist is answered with the one that was probably meant.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace seapile::commands {

/// The words after the program's name, with `run` before a study's file. `--no-color` is taken out and put into the
/// environment (NO_COLOR), where whatever prints looks for it.
std::vector<std::string> words_of(int count, char** arguments, const CLI::App& app);

/// What is wrong with a command or an option that does not exist, in one sentence with the nearest one that does; ""
/// when all exist.
std::string objection(const std::vector<std::string>& words, const CLI::App& app);

/// The commands that a user gives, in their order. Those without a group are for the program itself.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// The long names of a command's options with their dashes, in their order.
std::vector<std::string> long_options(const CLI::App& command);

}  // namespace seapile::commands
