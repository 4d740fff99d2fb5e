#include "runner/present/gnuplot.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/pipe.hpp>
#include <boost/process/search_path.hpp>
#include <cerrno>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;

// Okabe and Ito's colours, told apart by colour-blind readers; their yellow is too pale for a line on white.
constexpr std::string_view kColours[] = {"0072B2", "D55E00", "009E73", "CC79A7", "E69F00", "56B4E9", "444444"};
constexpr std::size_t kColourCount = std::size(kColours);
constexpr std::string_view kDashes[] = {"solid", "(12,5)", "(3,4)"};

constexpr int kTitleLine = 25, kNoteLine = 22;  // in pixels
constexpr std::size_t kMostTitleLines = 3;

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

/// gnuplot's SVG with what it cannot be told: bold as a weight, fonts to fall back to, spaces beside symbols,
/// no pop-up names of its own.
std::string finished(std::string svg) {
  replace_all(svg, R"(font-family="Helvetica:Bold")", R"(font-weight="bold" font-family="Helvetica")");
  replace_all(svg, R"(font-family="Helvetica")", R"(font-family="Helvetica, Arial, 'Liberation Sans', sans-serif")");
  replace_all(svg, "<text>", R"(<text xml:space="preserve">)");
  for (std::size_t at = 0; (at = svg.find("<title>", at)) != std::string::npos;) {
    svg.erase(at, svg.find("</title>", at) + std::string_view("</title>").size() - at);
  }
  return svg;
}

/// A file without a name: whoever dies while it is drawn on leaves nothing behind.
class Sheet {
 public:
  Sheet() : file_(::fdopen(::memfd_create("picture", MFD_CLOEXEC), "r+")) {
    if (file_ == nullptr) throw std::system_error(errno, std::generic_category(), "memory for the picture");
  }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;
  ~Sheet() { std::fclose(file_); }

  std::FILE* file() const { return file_; }

  /// What it holds from now on, to be read from its beginning.
  void put(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), file_);
    std::rewind(file_);
  }

  std::string text() const {
    std::string all;
    std::rewind(file_);
    char piece[1 << 14];
    for (std::size_t got; (got = std::fread(piece, 1, sizeof piece, file_)) > 0;) all.append(piece, got);
    return all;
  }

 private:
  std::FILE* file_;
};

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      result += ' ';
    } else if (std::string_view("\"\\`'$@").find(c) != std::string_view::npos) {
      result += fmt::format("\\{:03o}", byte);
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
  const auto length = [](const std::string& s) {
    return static_cast<std::size_t>(std::ranges::count_if(s, [](char c) { return (c & 0xC0) != 0x80; }));
  };
  std::vector<std::string> lines;
  std::string line, word;
  const auto take = [&] {
    if (word.empty()) return;
    if (!line.empty() && length(line) + 1 + length(word) > most) {
      lines.push_back(line);
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    word.clear();
  };
  for (const char c : text) {
    if (c == ' ' || c == '\n' || c == '\t') {
      take();
    } else {
      word += c;
    }
  }
  take();
  if (!line.empty()) lines.push_back(line);
  return lines;
}

Style style_of(std::size_t group) {
  return {kColours[group % kColourCount], kDashes[std::min(group / kColourCount, std::size(kDashes) - 1)]};
}

Heading heading(const std::string& title, const std::string& note, int width, int height, std::size_t most) {
  Heading result;
  result.script = fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {},{} dynamic rounded enhanced font 'Helvetica,15' background '#ffffff'\n",
      width, height);
  result.bottom = kHeadingSide;
  std::vector<std::string> lines = wrapped(title, most);
  if (lines.size() > kMostTitleLines) {
    lines.resize(kMostTitleLines);
    lines.back() += " …";
  }
  int label = 1;
  const auto put = [&](const std::string& line, int line_height, const char* font, const char* colour) {
    result.script += fmt::format("set label {} {} at screen {:.4f},{:.4f} left noenhanced font '{}' tc rgb '#{}'\n",
                                 label++, quoted(line), static_cast<double>(kHeadingSide) / width,
                                 1 - static_cast<double>(result.bottom) / height, font, colour);
    result.bottom += line_height;
  };
  for (const std::string& line : lines) put(line, kTitleLine, "Helvetica:Bold,18", "1a1a1a");
  put(note, kNoteLine, "Helvetica,14", "666666");
  return result;
}

std::string gnuplot_version() {
  namespace bp = boost::process;
  const auto gnuplot = bp::search_path("gnuplot");
  if (gnuplot.empty()) return "";
  bp::ipstream output;
  std::string line;
  std::error_code error;
  bp::child child(gnuplot, "--version", bp::std_in<bp::null, bp::std_out> output, bp::std_err > bp::null, error);
  if (error) return "";
  std::getline(output, line);
  child.wait(error);
  return error || child.exit_code() != 0 ? "" : line;
}

void draw_with_gnuplot(const std::string& script, const fs::path& svg) {
  namespace bp = boost::process;
  const auto fail = [&](const std::string& why) {
    throw store::StoreError(store::StoreError::Kind::io, fmt::format("{} was not drawn: {}", svg.string(), why));
  };
  const auto gnuplot = bp::search_path("gnuplot");
  if (gnuplot.empty()) fail("gnuplot is not installed");
  std::error_code error;
  fs::create_directories(svg.parent_path(), error);
  if (error) fail(error.message());

  std::string picture, complaint;
  int code = 0;
  try {
    const Sheet sheet;
    Sheet question;  // no pipe, whose writer dies of a gnuplot that was killed
    question.put(script);
    bp::ipstream output;
    bp::child child(bp::exe = gnuplot, bp::args = {"-d", "-"}, bp::std_in<question.file(), bp::std_out> sheet.file(),
                    bp::std_err > output);
    for (std::string line; std::getline(output, line);) {
      if (complaint.empty() && line.find_first_not_of(" \t^") != std::string::npos) complaint = line;
    }
    child.wait();
    code = child.exit_code();
    picture = sheet.text();
  } catch (const std::system_error& failure) {
    complaint = failure.what();
    code = -1;
  }
  const bool whole = picture.find("</svg>") != std::string::npos;
  if (code != 0 || !whole) fail(complaint.empty() ? fmt::format("gnuplot ended with code {}", code) : complaint);
  store::write_text(svg, finished(std::move(picture)));
}

}  // namespace seapile::present
