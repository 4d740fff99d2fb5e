// The commands of the program, one file each. A command adds itself to the application and says what to do when it is
// the one that was called.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "runner/execute/pool.h"
#include "runner/present/table.h"
#include "runner/store/catalogue.h"
#include "runner/study/study.h"

namespace seapile::commands {

/// What the called command does; returns the exit code.
using Call = std::function<int()>;

void add_run(CLI::App& app, Call& call);
void add_plan(CLI::App& app, Call& call);
void add_status(CLI::App& app, Call& call);
void add_submit(CLI::App& app, Call& call);
void add_jobs(CLI::App& app, Call& call);
void add_cancel(CLI::App& app, Call& call);
void add_query(CLI::App& app, Call& call);
void add_curve(CLI::App& app, Call& call);
void add_figure(CLI::App& app, Call& call);
void add_advise(CLI::App& app, Call& call);
void add_trade(CLI::App& app, Call& call);
void add_trend(CLI::App& app, Call& call);
void add_check(CLI::App& app, Call& call);
void add_compare(CLI::App& app, Call& call);
void add_probe(CLI::App& app, Call& call);
void add_export(CLI::App& app, Call& call);
void add_gc(CLI::App& app, Call& call);
void add_report(CLI::App& app, Call& call);
void add_show(CLI::App& app, Call& call);
void add_verify(CLI::App& app, Call& call);
void add_reindex(CLI::App& app, Call& call);
void add_schema(CLI::App& app, Call& call);
void add_new(CLI::App& app, Call& call);
void add_completion(CLI::App& app, Call& call);
void add_doctor(CLI::App& app, Call& call);
void add_ingest(CLI::App& app, Call& call);
void add_migrate(CLI::App& app, Call& call);
void add_exec(CLI::App& app, Call& call);

/// What the user asked for on the command line cannot be done as it stands; exit code 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Adds `--store`, the folder of all results.
void add_store_option(CLI::App& command, std::string& root);

/// Adds `--where`, conditions that all have to hold.
void add_where_option(CLI::App& command, std::vector<std::string>& where);

/// Adds `--set` and `--seeds`, what the command line changes in a study.
void add_study_options(CLI::App& command, study::Options& options);

/// Adds `--jobs`, `--threads`, `--memory` and `--oversubscribe`: how this machine is shared out among cases.
void add_sharing_options(CLI::App& command, execute::Sharing& sharing);

/// Lets an option be a number from `least` up.
CLI::Validator from_up(double least);

/// Lets an option be one of these names only, which its help lists; another word is answered with the nearest.
CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& names);

/// Adds `--format`.
void add_format_option(CLI::App& command, present::Format& format);

/// What `query`, `curve` and `trend` are limited to: the name of a study, or a study file, or "" for everything.
std::string study_name(const std::string& study);

/// Whether the catalogue knows the study ("": it need not); if not, says so on standard error.
bool is_known(const std::string& study, const store::Catalogue& catalogue);

/// Does `ask`; a name or condition that the catalogue does not know becomes a UsageError.
auto usage_checked(auto ask) {
  try {
    return ask();
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace seapile::commands
