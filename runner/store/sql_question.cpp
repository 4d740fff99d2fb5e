#include "runner/store/sql_question.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "runner/store/database.h"

namespace seapile::store {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kLongestValue = 16 * 1024 * 1024;  // [bytes] of one text or row that a question makes
constexpr int kInstructionsBetweenLooks = 1000;  // at the clock

struct Watch {
  Clock::time_point until;
  std::string refused;  ///< what was asked for beyond reading; SQLite does not say
};

/// SQLite asks for every access that a statement would make, before it is run.
int authorize(void* data, int action, const char* first, const char* second, const char*, const char*) {
  auto& watch = *static_cast<Watch*>(data);
  switch (action) {
    case SQLITE_SELECT:
    case SQLITE_READ:
    case SQLITE_RECURSIVE:
      return SQLITE_OK;
    case SQLITE_FUNCTION:
      if (std::strcmp(second, "load_extension") != 0 && std::strcmp(second, "fts3_tokenizer") != 0) return SQLITE_OK;
      watch.refused = fmt::format("the function {}", second);
      return SQLITE_DENY;
    case SQLITE_PRAGMA:
      watch.refused = fmt::format("PRAGMA {}", first);
      return SQLITE_DENY;
    case SQLITE_ATTACH:
      watch.refused = "ATTACH";
      return SQLITE_DENY;
    default:
      if (watch.refused.empty()) watch.refused = "a statement that is no SELECT";
      return SQLITE_DENY;
  }
}

int is_time_up(void* data) { return Clock::now() > static_cast<Watch*>(data)->until ? 1 : 0; }

using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

class Questioner {
 public:
  Questioner(SQLite::Database& sqlite, const SqlQuestion& question)
      : handle_(sqlite.getHandle()),
        question_(question),
        watch_{Clock::now() +
                   std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(question.time_limit)),
               ""} {
    sqlite.exec("PRAGMA query_only=ON");
    sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_limit(handle_, SQLITE_LIMIT_LENGTH, kLongestValue);
    sqlite3_set_authorizer(handle_, authorize, &watch_);
    sqlite3_progress_handler(handle_, kInstructionsBetweenLooks, is_time_up, &watch_);
  }
  Questioner(const Questioner&) = delete;
  Questioner& operator=(const Questioner&) = delete;
  ~Questioner() {
    sqlite3_progress_handler(handle_, 0, nullptr, nullptr);
    sqlite3_set_authorizer(handle_, nullptr, nullptr);
  }

  SqlAnswer answer() {
    const Statement statement = prepared();
    bind(statement.get());
    SqlAnswer answer;
    Table& table = answer.table;
    const int columns = sqlite3_column_count(statement.get());
    for (int i = 0; i < columns; ++i)
      table.columns.push_back(free_name(table.columns, sqlite3_column_name(statement.get(), i)));
    table.units.resize(table.columns.size());
    while (step(statement.get())) {
      if (table.rows.size() == question_.limit) {
        answer.more = true;
        break;
      }
      auto& row = table.rows.emplace_back();
      for (int i = 0; i < columns; ++i) row.push_back(cell(statement.get(), i));
    }
    return answer;
  }

 private:
  [[noreturn]] void refuse(int code) const {
    if (!watch_.refused.empty()) {
      throw std::invalid_argument("a question only reads: " + watch_.refused + " is refused");
    }
    switch (code & 0xff) {
      case SQLITE_INTERRUPT:
        throw std::invalid_argument(fmt::format(
            "the question was not answered within {:g} s: narrow it, or raise --time-limit", question_.time_limit));
      case SQLITE_TOOBIG:
        throw std::invalid_argument("the question makes texts of more than 16 MB");
      case SQLITE_CORRUPT:
      case SQLITE_NOTADB:
      case SQLITE_BUSY:
      case SQLITE_IOERR:
        throw SQLite::Exception(handle_, code);
      default:
        throw std::invalid_argument(fmt::format("SQLite says of the question: {}", sqlite3_errmsg(handle_)));
    }
  }

  Statement compiled(const char* text, const char** rest) const {
    sqlite3_stmt* statement = nullptr;
    const int code = sqlite3_prepare_v2(handle_, text, -1, &statement, rest);
    if (code != SQLITE_OK) refuse(code);
    return {statement, sqlite3_finalize};
  }

  Statement prepared() const {
    const char* rest = nullptr;
    Statement statement = compiled(question_.text.c_str(), &rest);
    if (!statement) throw std::invalid_argument("the question is empty");
    // Behind it there may be blanks and comments.
    sqlite3_stmt* second = nullptr;
    const int code = sqlite3_prepare_v2(handle_, rest, -1, &second, nullptr);
    sqlite3_finalize(second);
    if (second != nullptr || code != SQLITE_OK) throw std::invalid_argument("a question is one statement, not several");
    if (sqlite3_stmt_readonly(statement.get()) == 0) throw std::invalid_argument("a question only reads");
    return statement;
  }

  /// "NAME=VALUE" is for the parameter of that name (":NAME", "@NAME" or "$NAME"), everything else for the next
  /// one without a name. All of them have to be given.
  void bind(sqlite3_stmt* statement) const {
    const int count = sqlite3_bind_parameter_count(statement);
    std::vector<bool> bound(static_cast<std::size_t>(count) + 1, false);
    for (const std::string& text : question_.bind) {
      const auto equals = text.find('=');
      int index = 0;
      for (const char* sign : {":", "@", "$"}) {
        if (index == 0 && equals != text.npos) {
          index = sqlite3_bind_parameter_index(statement, (sign + text.substr(0, equals)).c_str());
        }
      }
      const std::string value = index > 0 ? text.substr(equals + 1) : text;
      for (int next = 1; index == 0 && next <= count; ++next) {
        const char* name = sqlite3_bind_parameter_name(statement, next);
        if (!bound[static_cast<std::size_t>(next)] && (name == nullptr || *name == '?')) index = next;
      }
      if (index == 0) throw std::invalid_argument("the question has no parameter for --bind \"" + text + "\"");
      bound[static_cast<std::size_t>(index)] = true;
      put_value(statement, index, value);
    }
    for (int index = 1; index <= count; ++index) {
      if (bound[static_cast<std::size_t>(index)]) continue;
      const char* name = sqlite3_bind_parameter_name(statement, index);
      throw std::invalid_argument(fmt::format("the parameter {} of the question has no value: --bind gives it one",
                                              name == nullptr ? fmt::format("?{}", index) : name));
    }
  }

  static void put_value(sqlite3_stmt* statement, int index, const std::string& text) {
    const char* end = text.data() + text.size();
    std::int64_t whole = 0;
    double number = 0;
    if (const auto read = std::from_chars(text.data(), end, whole); read.ptr == end && read.ec == std::errc{}) {
      sqlite3_bind_int64(statement, index, whole);
    } else if (const auto real = std::from_chars(text.data(), end, number);
               real.ptr == end && real.ec == std::errc{} && std::isfinite(number)) {
      sqlite3_bind_double(statement, index, number);
    } else {
      sqlite3_bind_text(statement, index, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    }
  }

  bool step(sqlite3_stmt* statement) const {
    const int code = sqlite3_step(statement);
    if (code != SQLITE_ROW && code != SQLITE_DONE) refuse(code);
    return code == SQLITE_ROW;
  }

  /// Columns of one name would be one member of a JSON object.
  static std::string free_name(const std::vector<std::string>& taken, const std::string& name) {
    std::string free = name;
    for (int i = 2; std::ranges::find(taken, free) != taken.end(); ++i) free = fmt::format("{}_{}", name, i);
    return free;
  }

  /// A whole number that a double does not hold keeps its digits as a text; bytes are shown as hex digits.
  static Cell cell(sqlite3_stmt* statement, int index) {
    switch (sqlite3_column_type(statement, index)) {
      case SQLITE_NULL:
        return {};
      case SQLITE_INTEGER: {
        const std::int64_t whole = sqlite3_column_int64(statement, index);
        constexpr std::int64_t kMost = std::int64_t{1} << 53;
        if (whole > kMost || whole < -kMost) return std::to_string(whole);
        return static_cast<double>(whole);
      }
      case SQLITE_FLOAT:
        return sqlite3_column_double(statement, index);
      case SQLITE_BLOB: {
        const auto* bytes = static_cast<const unsigned char*>(sqlite3_column_blob(statement, index));
        std::string digits;
        for (int i = 0; i < sqlite3_column_bytes(statement, index); ++i) digits += fmt::format("{:02x}", bytes[i]);
        return digits;
      }
      default:
        return std::string(reinterpret_cast<const char*>(sqlite3_column_text(statement, index)),
                           static_cast<std::size_t>(sqlite3_column_bytes(statement, index)));
    }
  }

  sqlite3* handle_;
  const SqlQuestion& question_;
  Watch watch_;
};

}  // namespace

SqlAnswer ask(const std::filesystem::path& root, const SqlQuestion& question) {
  Database database = Database::open_for_reading(root);
  return guarded(database.file(), [&] { return Questioner(database.sqlite(), question).answer(); });
}

}  // namespace seapile::store
