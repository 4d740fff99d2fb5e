#include "tests/verification/document.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace seapile::verification {
namespace {

const std::string kEnd = "<!-- end -->\n";

std::string begin_of(const std::string& law) { return "<!-- rows of " + law + " -->\n"; }

const char* sign(Relation relation) {
  return relation == Relation::equals ? "" : relation == Relation::at_most ? "&le; " : "&ge; ";
}

}  // namespace

std::string row_head(const Row& row, const std::string& solver) {
  return fmt::format("| {}{} | {} |", row.quantity, row.unit == "-" ? "" : " [" + row.unit + "]", solver);
}

std::string table(const std::vector<SolverRow>& rows) {
  std::string text =
      "| quantity | solver | where | value | closed form | difference | tolerance | tolerance, because |\n"
      "|---|---|---|---:|---:|---:|---:|---|\n";
  for (const auto& [solver, row] : rows)
    text += fmt::format("{} {} | {:.6g} | {}{:.6g} | {:.2g} | {:.2g} | {}{} |\n", row_head(row, solver), row.where,
                        row.value, sign(row.relation), row.expected, row.difference(), row.tolerance, row.why,
                        row.holds() ? "" : " **does not hold**");
  return text;
}

Tables tables_of(const std::string& text) {
  Tables tables;
  const std::string begin = "<!-- rows of ";
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t name = at + begin.size(), name_end = text.find(" -->\n", name);
    const std::size_t end = text.find(kEnd, at);
    if (name_end == std::string::npos || end == std::string::npos)
      throw std::runtime_error("a table without its end marker: " + text.substr(at, 60));
    tables[text.substr(name, name_end - name)] = text.substr(name_end + 5, end - name_end - 5);
  }
  return tables;
}

std::vector<std::string> headings_of(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("### ")) names.push_back(line.substr(4));
  return names;
}

std::string read_document(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw std::runtime_error(path + " cannot be read");
  return text.str();
}

void put_tables(const std::string& path, const Tables& tables) {
  std::string text = read_document(path);
  for (const auto& [law, rows] : tables) {
    const std::size_t begin = text.find(begin_of(law));
    const std::size_t end = begin == std::string::npos ? begin : text.find(kEnd, begin);
    if (end == std::string::npos) throw std::runtime_error(path + " lacks the place of the table of " + law);
    const std::size_t first = begin + begin_of(law).size();
    text.replace(first, end - first, rows);
  }
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + " cannot be written");
}

}  // namespace seapile::verification
