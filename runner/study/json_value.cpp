#include "runner/study/json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <unordered_set>

namespace seapile::study {
namespace {

constexpr std::int64_t kLargestInteger = std::int64_t{1} << 53;
constexpr const char* kRules = "strict JSON: no comments, no NaN or Infinity, no trailing commas";

/// Control and direction characters, which would let a text show something else than it is.
bool has_invisible(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned a = byte(i), b = byte(i + 1), c = byte(i + 2);
    if (a < 0x20 || a == 0x7f) return true;
    if (a == 0xc2 && b >= 0x80 && b <= 0x9f) return true;                 // U+0080..U+009F
    if (a == 0xe2 && b == 0x80 && (c >= 0xaa && c <= 0xae)) return true;  // U+202A..U+202E
    if (a == 0xe2 && b == 0x81 && (c >= 0xa6 && c <= 0xa9)) return true;  // U+2066..U+2069
  }
  return false;
}

std::string line_and_column(std::string_view bytes, std::size_t at) {
  const std::string_view before = bytes.substr(0, at);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return fmt::format("line {}, column {}", line, at - line_start + 1);
}

/// Builds the tree from the parser's events. Only the innermost open container grows, so the pointers in `open_` hold.
class Builder {
 public:
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  Builder(const std::string& root, base::Problems& problems) : root_(root_place(root)), problems_(problems) {}

  Value take() { return std::move(document_); }

  bool null() { return add({}); }
  bool boolean(bool truth) { return add(truth_value(truth, nullptr)); }
  bool number_integer(number_integer_t number) {
    return number < -kLargestInteger ? beyond(std::to_string(number))
                                     : add(number_value(static_cast<double>(number), nullptr));
  }
  bool number_unsigned(number_unsigned_t number) {
    return number > static_cast<number_unsigned_t>(kLargestInteger)
               ? beyond(std::to_string(number))
               : add(number_value(static_cast<double>(number), nullptr));
  }
  bool number_float(number_float_t number, const string_t& raw) {
    if (raw.find_first_of(".eE") == std::string::npos) return beyond(raw);  // More digits than 64 bits hold.
    const std::string_view mantissa = std::string_view(raw).substr(0, raw.find_first_of("eE"));
    if (number == 0 && mantissa.find_first_of("123456789") != std::string_view::npos) {
      return refuse(fmt::format("{} is too small: it would be stored as 0", raw), "0, or at least about 1e-307");
    }
    return add(number_value(number, nullptr));
  }
  bool string(string_t& text) {
    if (has_invisible(text)) return refuse("has a control character in its text", "printable text");
    return add(string_value(std::move(text), nullptr));
  }
  bool binary(binary_t&) { return false; }  // Not JSON.

  bool start_object(std::size_t) { return open(Value::Kind::object); }
  bool start_array(std::size_t) { return open(Value::Kind::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(string_t& text) {
    Level& level = open_.back();
    level.key = text;
    level.value_due = true;
    level.duplicate = !level.keys.insert(text).second;
    if (level.duplicate) problems_.push_back({pointer(next_place()), "is a duplicate key", "each key once", ""});
    if (has_invisible(text)) {
      problems_.push_back({pointer(next_place()), "has a control character in its key", "printable text", ""});
    }
    return true;
  }

  bool parse_error(std::size_t, const std::string& last_token, const nlohmann::detail::exception& error) {
    if (error.id == 406) {
      return stop(fmt::format("{} overflows", last_token.substr(0, 60)), "at most about 1.8e308 in magnitude");
    }
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    std::string what = error.what();
    if (const auto at = what.find("parse error at "); at != std::string::npos) what = what.substr(at + 15);
    if (what.find("ill-formed UTF-8") != std::string::npos) {
      return stop(what.substr(0, what.find(": ")) + ": ill-formed UTF-8", "UTF-8 text");
    }
    return stop(what.substr(0, 300), kRules);
  }

 private:
  struct Level {
    Value* container;
    std::unordered_set<std::string> keys;
    std::string key;
    bool duplicate = false;
    bool value_due = false;  ///< a key has been read, and its value not yet
  };

  PlacePtr next_place() const {
    if (open_.empty()) return root_;
    const Level& level = open_.back();
    const bool in_array = level.container->kind == Value::Kind::array;
    return place_in(level.container->place, in_array ? std::to_string(level.container->items.size()) : level.key);
  }

  bool stop(std::string what, std::string allowed) {
    const bool between_members =
        !open_.empty() && open_.back().container->kind == Value::Kind::object && !open_.back().value_due;
    const PlacePtr place = between_members ? open_.back().container->place : next_place();
    problems_.push_back({pointer(place), std::move(what), std::move(allowed), ""});
    return false;
  }

  /// Reports a value and goes on: the rest of the text may hold more problems.
  bool refuse(std::string what, std::string allowed) {
    problems_.push_back({pointer(next_place()), std::move(what), std::move(allowed), ""});
    Value value;
    value.kind = Value::Kind::unusable;
    return add(std::move(value));
  }

  bool beyond(const std::string& integer) {
    return refuse(fmt::format("{} is an integer beyond 2^53", integer.substr(0, 60)),
                  "from -9007199254740992 to 9007199254740992");
  }

  Value* place(Value value) {
    if (++count_ > kMostValues) {
      stop(fmt::format("is one value too many: the file has more than {}", kMostValues), "");
      return nullptr;
    }
    value.place = next_place();
    if (open_.empty()) {
      document_ = std::move(value);
      return &document_;
    }
    Level& level = open_.back();
    if (level.container->kind == Value::Kind::object) {
      level.value_due = false;
      // A second value of a key was reported; it replaces the first so that the keys stay unique.
      if (level.duplicate) return &level.container->put(level.key, std::move(value));
      level.container->keys.push_back(level.key);
    }
    return &level.container->items.emplace_back(std::move(value));
  }

  bool add(Value value) { return place(std::move(value)) != nullptr; }

  bool open(Value::Kind kind) {
    if (open_.size() == kDeepest) {
      return stop(fmt::format("is nested deeper than {} levels", kDeepest), fmt::format("at most {} levels", kDeepest));
    }
    Value value;
    value.kind = kind;
    Value* container = place(std::move(value));
    if (container) open_.push_back({container, {}, {}});
    return container != nullptr;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  PlacePtr root_;
  base::Problems& problems_;
  Value document_;
  std::vector<Level> open_;
  std::size_t count_ = 0;
};

}  // namespace

PlacePtr root_place(std::string name) { return std::make_shared<const Place>(Place{nullptr, std::move(name)}); }

PlacePtr place_in(PlacePtr up, std::string token) {
  return std::make_shared<const Place>(Place{std::move(up), std::move(token)});
}

std::string pointer(const PlacePtr& place) {
  if (!place) return "";
  if (!place->up) return place->token;
  std::string escaped;
  for (const char c : place->token) {
    if (c == '~') {
      escaped += "~0";
    } else if (c == '/') {
      escaped += "~1";
    } else {
      escaped += c;
    }
  }
  return pointer(place->up) + "/" + escaped;
}

const Value* Value::find(std::string_view key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

Value* Value::find(std::string_view key) { return const_cast<Value*>(std::as_const(*this).find(key)); }

Value& Value::put(std::string key, Value value) {
  if (Value* old = find(key)) return *old = std::move(value);
  keys.push_back(std::move(key));
  return items.emplace_back(std::move(value));
}

namespace {

Value value_of(Value::Kind kind, PlacePtr place) {
  Value value;
  value.kind = kind;
  value.place = std::move(place);
  return value;
}

}  // namespace

Value number_value(double number, PlacePtr place) {
  Value value = value_of(Value::Kind::number, std::move(place));
  value.number = number;
  return value;
}

Value string_value(std::string text, PlacePtr place) {
  Value value = value_of(Value::Kind::string, std::move(place));
  value.text = std::move(text);
  return value;
}

Value truth_value(bool truth, PlacePtr place) {
  Value value = value_of(Value::Kind::boolean, std::move(place));
  value.truth = truth;
  return value;
}

Value object_value(PlacePtr place) { return value_of(Value::Kind::object, std::move(place)); }

std::string kind_name(const Value& value) {
  switch (value.kind) {
    case Value::Kind::null:
      return "null";
    case Value::Kind::boolean:
      return value.truth ? "true" : "false";
    case Value::Kind::number:
      return "a number";
    case Value::Kind::string:
      return "a string";
    case Value::Kind::array:
      return "an array";
    case Value::Kind::object:
      return "an object";
    case Value::Kind::unusable:
      break;
  }
  return "unusable";
}

Value read_json(std::string_view bytes, const std::string& root, base::Problems& problems) {
  Value unusable;
  unusable.kind = Value::Kind::unusable;
  const auto refuse = [&](std::string what, std::string allowed) {
    problems.push_back({root, std::move(what), std::move(allowed), ""});
    return unusable;
  };
  if (bytes.size() > kMostBytes) {
    return refuse("is larger than 16 MiB", "at most 16 MiB");
  }
  if (bytes.substr(0, 3) == "\xef\xbb\xbf" || bytes.substr(0, 2) == "\xff\xfe" || bytes.substr(0, 2) == "\xfe\xff") {
    return refuse("begins with a byte order mark", "UTF-8 text without one");
  }
  // The parser below would take a NUL for the end of the text.
  const auto control = std::find_if(bytes.begin(), bytes.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t';
  });
  if (control != bytes.end()) {
    const auto at = static_cast<std::size_t>(control - bytes.begin());
    return refuse(fmt::format("{}: control character {:#04x}", line_and_column(bytes, at),
                              static_cast<unsigned>(static_cast<unsigned char>(*control))),
                  "text");
  }
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) return refuse("is empty", "a JSON text");

  Builder builder(root, problems);
  const bool whole = nlohmann::json::sax_parse(bytes.begin(), bytes.end(), &builder);
  return whole ? builder.take() : unusable;
}

}  // namespace seapile::study
