#include <fmt/format.h>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/schema_text.h"
#include "runner/study/field_reader.h"
#include "runner/study/json_schema.h"
#include "runner/study/schema.h"

namespace seapile::commands {
namespace {

struct SchemaArguments {
  std::string of;
  present::Format format = present::Format::json;
};

/// What a field may be, in words: a range, names, or a kind.
std::string allowed(const study::SchemaNode& node) {
  using Kind = study::SchemaNode::Kind;
  const auto with_null = [&](const std::string& text) { return node.nullable ? text + ", null" : text; };
  switch (node.kind) {
    case Kind::number:
    case Kind::integer:
    case Kind::numbers:
      return with_null(study::range_text(node.field));
    case Kind::boolean:
      return with_null("true, false");
    case Kind::string:
      return with_null("a text");
    case Kind::choice:
      return with_null(fmt::format("{}", fmt::join(node.names, ", ")));
    case Kind::variant:
      return with_null(fmt::format("{}", fmt::join(node.child_names(), ", ")));
    case Kind::spec:
      break;
  }
  return with_null("as below");
}

void add_rows(const study::SchemaNode& node, const std::string& prefix, store::Table& table) {
  for (const study::SchemaNode& child : node.children) {
    const std::string path = prefix + std::string(child.field.key);
    table.rows.push_back({path, child.fallback, allowed(child), std::string(child.field.meaning)});
    add_rows(child, path + ".", table);
  }
}

/// Every field of the scene and of the record, a row each.
store::Table fields_of_a_study() {
  store::Table table{{"path", "default", "allowed", "meaning"}, {"", "", "", ""}, {}};
  add_rows(study::scene_schema(), "", table);
  add_rows(study::record_schema(), "record.", table);
  return table;
}

int print_schema(const SchemaArguments& arguments) {
  if (arguments.of == "study") {
    const bool json_schema = arguments.format == present::Format::json;
    fmt::print("{}", json_schema ? study::study_json_schema() : present::text(fields_of_a_study(), arguments.format));
  } else {
    fmt::print("{}", arguments.of == "result" ? store::result_file_text() : store::catalogue_text());
  }
  return execute::kDone;
}

}  // namespace

void add_schema(CLI::App& app, Call& call) {
  static SchemaArguments arguments;
  CLI::App* command = app.add_subcommand("schema", "Say what may stand in a study, or what stands in results");
  one_of(command->add_option("OF", arguments.of, "A study file, the files of a run, or the catalogue's tables"),
         {"study", "result", "catalogue"})
      ->required();
  add_format_option(*command, arguments.format);
  command->footer(
      "study: a JSON Schema (draft 7), with which an editor completes and checks study files; with --format table, "
      "csv\n"
      "or ndjson the list of all fields of a scene and of a record. result: every path in every file of a run, with\n"
      "type, shape, unit and meaning, in Markdown. catalogue: its tables, in SQL.\n\n"
      "Examples:\n"
      "  runner schema study > study.schema.json\n"
      "  runner schema study --format table | grep friction\n"
      "  runner schema result | less\n"
      "  runner schema catalogue | sqlite3 empty.sqlite");
  command->callback([&call] { call = [] { return print_schema(arguments); }; });
}

}  // namespace seapile::commands
