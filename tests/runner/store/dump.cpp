#include "tests/runner/store/dump.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <regex>
#include <vector>

namespace seapile::store::sample {

namespace {

std::vector<std::string> rows(SQLite::Database& sqlite, const std::string& question) {
  std::vector<std::string> all;
  SQLite::Statement statement(sqlite, question);
  while (statement.executeStep()) {
    std::string row;
    for (int i = 0; i < statement.getColumnCount(); ++i) {
      row += (statement.getColumn(i).isNull() ? "NULL" : statement.getColumn(i).getString()) + "|";
    }
    all.push_back(row);
  }
  return all;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

std::vector<std::string> tables(SQLite::Database& sqlite) {
  std::vector<std::string> names;
  SQLite::Statement all(sqlite, "SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name");
  while (all.executeStep()) names.push_back(all.getColumn(0).getString());
  return names;
}

/// Comments, quotes around names, and how the text is broken into lines mean nothing.
std::string plain(std::string text) {
  text = std::regex_replace(text, std::regex("--[^\n]*"), "");
  text = std::regex_replace(text, std::regex("\""), "");
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

}  // namespace

std::map<std::string, std::string> rows_of_all_tables(const std::filesystem::path& catalogue) {
  SQLite::Database sqlite(catalogue.string(), SQLite::OPEN_READONLY);
  std::map<std::string, std::string> all;
  for (const std::string& table : tables(sqlite)) {
    std::vector<std::string> lines = rows(sqlite, "SELECT * FROM " + table);
    std::ranges::sort(lines);
    all[table] = joined(lines);
  }
  return all;
}

std::map<std::string, std::string> schema_of(const std::filesystem::path& catalogue) {
  SQLite::Database sqlite(catalogue.string(), SQLite::OPEN_READONLY);
  std::map<std::string, std::string> all;
  SQLite::Statement texts(sqlite, "SELECT type || ' ' || name, coalesce(sql, '') FROM sqlite_schema");
  while (texts.executeStep()) all[texts.getColumn(0).getString()] = plain(texts.getColumn(1).getString());
  for (const std::string& table : tables(sqlite)) {
    all["columns of " + table] = joined(rows(sqlite, "PRAGMA table_xinfo(" + table + ")"));
    all["keys of " + table] = joined(rows(sqlite, "PRAGMA foreign_key_list(" + table + ")"));
  }
  return all;
}

}  // namespace seapile::store::sample
