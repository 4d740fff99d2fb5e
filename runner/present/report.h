// What a report of a study shows. Everything is gathered here before a word of the file is written.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runner/present/table.h"

namespace seapile::present {

/// What a word says of itself by its colour too.
enum class Tone {
  plain,
  good,     ///< as it should be
  bad,      ///< failed
  open,     ///< cannot be decided, or is not up to date
  finding,  ///< an answer, and neither good nor bad
};

/// "12 done".
struct ReportCount {
  std::string words;
  Tone tone = Tone::plain;
};

struct ReportTable {
  std::string caption;
  store::Table table;
  std::vector<std::size_t> means = {};    ///< as text() takes them
  std::string toned = {};                 ///< column that is coloured
  std::vector<Tone> tones = {};           ///< of its rows
  std::vector<std::string> notes = {};    ///< sentences below it
  std::optional<store::Table> full = {};  ///< what is copied as CSV, where it holds more than is shown
  bool folded = false;                    ///< seen once it is asked for
};

struct ReportAxis {
  std::string name, unit;
};

enum class LineKind {
  record,     ///< as it was recorded, thinned
  mean,       ///< over the bins of depth, and over the packings
  band,       ///< outline of the interval of the mean
  reference,  ///< points that a check names, with their tolerance
};

/// In the order of the path, which may turn back: a pile that moves up and down draws loops.
struct ReportLine {
  LineKind kind = LineKind::record;
  std::size_t group = 0;
  std::string label;
  std::vector<double> x, y;            ///< not finite: a gap
  std::vector<double> tolerance = {};  ///< of x at each point of a reference
};

struct ReportChart {
  std::string title, note;
  ReportAxis x, y;
  bool downwards = false;  ///< y grows downwards and the x axis is on top: depth
  bool records = true;     ///< the records are seen from the start
  std::vector<std::string> groups = {};
  std::vector<ReportLine> lines = {};
  ReportTable values = {};  ///< the chart in numbers, for those who cannot see it
};

/// One bar per row of its table.
struct ReportBars {
  std::string title;
  ReportAxis x;
  std::vector<std::string> labels;
  std::vector<double> values;
};

struct ReportPicture {
  std::string name;
  std::string svg;  ///< the file's bytes; shown as an image, in which no script runs
};

/// A run that did not come to its end as it should.
struct ReportLog {
  std::string title, outcome, reason;
  std::string where, log;  ///< name and last lines of the log
};

struct ReportText {
  std::vector<std::string> paragraphs;
};

using ReportBlock = std::variant<ReportText, ReportTable, ReportChart, ReportBars, ReportPicture, ReportLog>;

struct ReportSection {
  std::string id, title;
  std::vector<ReportBlock> blocks;
};

/// Its texts may hold any character, and any byte.
struct Report {
  std::string study, question, made;
  std::vector<ReportCount> counts;
  std::vector<ReportSection> sections;
};

/// The report as one HTML file that asks for nothing from anywhere: style, scripts, data and pictures are in it. What
/// comes from a study is in one JSON island, and becomes text of the page, never markup.
std::string report_html(const Report& report);

}  // namespace seapile::present
