// docs/study.md lists every field of a scene; the list is made here from the field lists themselves.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <sstream>

#include "runner/study/field_reader.h"
#include "runner/study/unit.h"
#include "solver/scene/spec.h"

namespace seapile::study {
namespace {

/// One line of the table for each member that holds a value.
class Table {
 public:
  template <class Spec>
  void add(Spec& spec, const std::string& prefix) {
    const auto visit = [&](const base::Field& field, auto& member) {
      add_member(field, member, prefix + std::string(field.key));
    };
    fields(visit, spec);
  }
  std::string text = "| path | default | allowed | meaning |\n|---|---|---|---|\n";

 private:
  void row(const std::string& path, const std::string& fallback, const std::string& allowed, std::string_view meaning) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", path, fallback, allowed, meaning);
  }

  static std::string with_unit(double number, const base::Field& field) {
    if (field.unit == "rad") return fmt::format("{:.6g} deg", number * 180 / std::numbers::pi);
    return number_text(number) + (field.unit == "-" ? "" : fmt::format(" {}", field.unit));
  }

  template <class T>
  void add_member(const base::Field& field, T& member, const std::string& path) {
    if constexpr (std::is_same_v<T, std::optional<double>>) {
      row(path, member ? with_unit(*member, field) : "null", range_text(field) + ", null", field.meaning);
    } else if constexpr (kIsOptional<T>) {
      row(path, member ? "as below" : "null", "null or as below", field.meaning);
      add(member.emplace(), path + ".");
    } else if constexpr (kIsVariant<T>) {
      row(path, alternative_names(member)[member.index()],
          fmt::format("{}", fmt::join(alternative_names(member), ", ")), field.meaning);
      for (std::size_t i = 0; i < std::variant_size_v<T>; ++i) {
        emplace_alternative(member, i);
        std::visit([&](auto& alternative) { add(alternative, path + "." + alternative.kName + "."); }, member);
      }
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      std::string numbers;
      for (const double number : member) numbers += (numbers.empty() ? "" : ", ") + number_text(number);
      row(path, fmt::format("[{}] {}", numbers, field.unit), range_text(field), field.meaning);
    } else if constexpr (std::is_same_v<T, std::string>) {
      row(path, "\"\"", "a path", field.meaning);
    } else if constexpr (std::is_enum_v<T>) {
      row(path, enum_names<T>()[static_cast<std::size_t>(member)], fmt::format("{}", fmt::join(enum_names<T>(), ", ")),
          field.meaning);
    } else if constexpr (std::is_same_v<T, bool>) {
      row(path, member ? "true" : "false", "true, false", field.meaning);
    } else if constexpr (std::is_arithmetic_v<T>) {
      row(path, with_unit(static_cast<double>(member), field), range_text(field), field.meaning);
    } else if constexpr (std::is_same_v<T, grains::ContactSpec>) {
      if (path == "contact") {
        add(member, path + ".");
      } else {
        row(path, "as `contact`", "the members of `contact`", field.meaning);
      }
    } else {
      add(member, path + ".");
    }
  }
};

TEST(StudyReference, ListsEveryFieldAsItIs) {
  scene::SceneSpec scene;
  scene::RecordSpec record;
  Table table;
  table.add(scene, "");
  table.add(record, "record.");

  std::ifstream file(SEAPILE_SOURCE_DIR "/docs/study.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find(table.text), std::string::npos) << "docs/study.md has to hold this table:\n\n"
                                                            << table.text;
}

}  // namespace
}  // namespace seapile::study
