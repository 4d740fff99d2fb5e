#include "runner/study/csv.h"

#include <fmt/format.h>

#include <algorithm>

#include "runner/study/problem_text.h"

namespace seapile::study {
namespace {

constexpr std::size_t kMostProblems = 20;

/// Takes one line apart; absent with one clause in `trouble`.
std::optional<std::vector<std::string>> split(std::string_view line, std::string& trouble) {
  std::vector<std::string> fields;
  while (true) {
    line = trimmed(line);
    std::string field;
    if (line.starts_with('"')) {
      std::size_t at = 1;
      for (; at < line.size(); ++at) {
        const bool quote = line[at] == '"', doubled = quote && line.substr(at + 1).starts_with('"');
        if (quote && !doubled) break;
        at += doubled ? 1 : 0;
        field += line[at];
      }
      if (at >= line.size()) {
        trouble = "has a quote that is not closed";
        return {};
      }
      line = trimmed(line.substr(at + 1));
      if (!line.empty() && !line.starts_with(',')) {
        trouble = "has text behind a closing quote";
        return {};
      }
    } else {
      const std::size_t comma = std::min(line.find(','), line.size());
      field = trimmed(line.substr(0, comma));
      line.remove_prefix(comma);
    }
    fields.push_back(std::move(field));
    if (line.empty()) return fields;
    line.remove_prefix(1);
  }
}

}  // namespace

void LineProblems::refuse(std::size_t line, const std::string& what, std::string allowed, std::string nearest) {
  ++count_;
  if (count_ > kMostProblems) return;
  problems_.push_back({"", fmt::format("line {}: {}", line, what), std::move(allowed), std::move(nearest)});
}

void LineProblems::finish() {
  if (count_ <= kMostProblems) return;
  problems_.push_back({"", fmt::format("and {} more lines with problems", count_ - kMostProblems), "", ""});
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

std::vector<CsvRecord> read_csv(std::string_view text, std::size_t first_line, LineProblems& problems) {
  std::vector<CsvRecord> records;
  std::size_t line_number = first_line;
  for (std::size_t start = 0; start < text.size(); ++line_number) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string line(trimmed(text.substr(start, end - start)));
    start = end + 1;
    if (line.empty()) continue;
    std::string trouble;
    std::optional<std::vector<std::string>> fields;
    if (is_printable(line)) {
      fields = split(line, trouble);
    } else {
      trouble = "has control characters or is not UTF-8";
    }
    if (fields) {
      records.push_back({line_number, *std::move(fields)});
    } else {
      problems.refuse(line_number, trouble, "fields with commas between them; \"...\" around one that holds a comma");
    }
  }
  return records;
}

CsvHeading csv_heading_of(const std::string& field) {
  const std::size_t open = field.find('[');
  if (open == std::string::npos || !field.ends_with(']')) return {field, ""};
  return {std::string(trimmed(field.substr(0, open))),
          std::string(trimmed(field.substr(open + 1, field.size() - open - 2)))};
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    // Blanks at the ends would be taken away on reading.
    if (fields[i].find_first_of(",\"") == std::string::npos && trimmed(fields[i]) == fields[i]) {
      line += fields[i];
      continue;
    }
    line += '"';
    for (const char c : fields[i]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + '\n';
}

}  // namespace seapile::study
