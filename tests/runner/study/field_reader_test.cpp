#include "runner/study/field_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "runner/study/schema.h"
#include "solver/scene/spec.h"

namespace seapile::study {
namespace {

template <class Spec>
Spec good(std::string_view json) {
  base::Problems problems;
  Spec spec;
  read_spec(read_json(json, "", problems), spec, problems);
  EXPECT_TRUE(problems.empty()) << problems[0].pointer << " " << problems[0].what;
  return spec;
}

TEST(FieldReader, WhatIsNotWrittenKeepsItsDefault) {
  EXPECT_EQ(good<scene::SceneSpec>("{}"), scene::SceneSpec{});
  EXPECT_EQ(*good<scene::SceneSpec>(R"({"pile": {}})").pile, pile::PileSpec{});
  EXPECT_EQ(good<scene::RecordSpec>("{}"), scene::RecordSpec{});
}

TEST(FieldReader, EveryKindOfMemberIsRead) {
  const auto scene = good<scene::SceneSpec>(R"({
    "bed": {"grains": {"count": 500, "radius": {"max": "19 mm"}}, "seed": 7, "file": "grains.csv",
            "preparation": {"solid_fraction": "82 %"}},
    "pile": {"tip": "flat", "driving": {"vibratory": {"frequency": "25 Hz"}}, "depth": null, "duration": "3 s"},
    "fluid": null, "contact": {"precision": "double"}})");
  EXPECT_EQ(scene.bed.grains.count, 500);
  EXPECT_EQ(scene.bed.grains.radius.max, 0.019);
  EXPECT_EQ(scene.bed.seed, 7u);
  EXPECT_EQ(scene.bed.file, "grains.csv");
  EXPECT_EQ(scene.bed.preparation.solid_fraction, 0.82);
  EXPECT_EQ(scene.pile->tip, pile::Tip(pile::FlatTip{}));
  EXPECT_EQ(scene.pile->driving, pile::Driving(pile::VibratoryDriving{0.06, 1e-3, 25}));
  EXPECT_EQ(scene.pile->depth, std::nullopt);
  EXPECT_EQ(scene.pile->duration, 3);
  EXPECT_EQ(scene.contact.precision, grains::Precision::double_);
  EXPECT_EQ(good<scene::RecordSpec>(R"({"frames": [0, "20 cm"]})").frames, (std::vector<double>{0, 0.2}));
}

TEST(FieldReader, ANameAloneIsTheAlternativeWithItsDefaults) {
  EXPECT_EQ(good<pile::PileSpec>(R"({"tip": "conical"})"), good<pile::PileSpec>(R"({"tip": {"conical": {}}})"));
  EXPECT_EQ(good<pile::PileSpec>(R"({"tip": {"conical": {"apex_angle": "60 deg"}}})"), pile::PileSpec{});
}

TEST(FieldReader, AWholeNumberMayBeSpelledInAnyWay) {
  for (const char* count : {"1000", "1000.0", "1e3", "10E+2"}) {
    EXPECT_EQ(good<grains::GrainsSpec>(std::string(R"({"count": )") + count + "}").count, 1000) << count;
  }
}

TEST(FieldReader, MinusZeroIsZero) {
  EXPECT_FALSE(std::signbit(good<pile::PileSpec>(R"({"friction": -0.0})").friction));
}

TEST(FieldReader, AProblemLeavesTheMemberAsItWas) {
  base::Problems problems;
  pile::PileSpec pile;
  read_spec(read_json(R"({"radius": -1, "tip": "round", "depth": "1 s", "friction": 0.25})", "", problems), pile,
            problems);
  EXPECT_EQ(problems.size(), 3u);
  EXPECT_EQ(pile.radius, 0.125);
  EXPECT_EQ(pile.tip, pile::Tip(pile::ConicalTip{}));
  EXPECT_EQ(pile.depth, 1.2);
  EXPECT_EQ(pile.friction, 0.25);
}

TEST(RangeText, SaysWhatANumberMayBe) {
  EXPECT_EQ(range_text({"x", "-", base::between(0, 10), ""}), "from 0 to 10");
  EXPECT_EQ(range_text({"x", "m", base::positive(100), ""}), "more than 0 m, at most 100 m");
  EXPECT_EQ(range_text({"x", "rad", base::between(0, 3.14159265358979), ""}), "from 0 deg to 180 deg");
  EXPECT_EQ(range_text({"x", "s", {}, ""}), "a number in s");
  EXPECT_EQ(range_text({"x", "s", {.min = 1}, ""}), "at least 1 s");
  EXPECT_EQ(range_text({"x", "s", {.max = 1, .open_max = true}, ""}), "less than 1 s");
}

TEST(Schema, HasEveryPathOnce) {
  const auto paths = all_paths(scene_schema());
  EXPECT_EQ(std::set<std::string>(paths.begin(), paths.end()).size(), paths.size());
  for (const char* path : {"bed.grains.radius.max", "pile.tip.conical.apex_angle", "pile.driving.vibratory.amplitude",
                           "bed.preparation.contact.substeps", "fluid", "pile.depth"}) {
    EXPECT_NE(std::find(paths.begin(), paths.end(), path), paths.end()) << path;
  }
}

TEST(Schema, APathIsFoundAsFarAsItExists) {
  std::size_t known = 0;
  EXPECT_EQ(find_node(scene_schema(), split_path("pile.depth"), known)->field.unit, "m");
  EXPECT_EQ(known, 2u);
  EXPECT_EQ(find_node(scene_schema(), split_path("pile.tip.round.angle"), known), nullptr);
  EXPECT_EQ(known, 2u);
}

// A default outside its own range could not be written down by anyone.
TEST(Schema, DefaultsAreInTheirRanges) {
  const auto check = [](auto&& self, auto& spec) -> void {
    const auto visit = [&](const base::Field& field, auto& member) {
      using T = std::remove_cvref_t<decltype(member)>;
      if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::int64_t> || std::is_same_v<T, std::uint64_t>) {
        EXPECT_TRUE(field.range.contains(static_cast<double>(member))) << field.key;
      } else if constexpr (kIsOptional<T>) {
        if constexpr (std::is_same_v<T, std::optional<double>>) {
          EXPECT_TRUE(!member || field.range.contains(*member)) << field.key;
        }
      } else if constexpr (kIsVariant<T>) {
        for (std::size_t i = 0; i < std::variant_size_v<T>; ++i) {
          emplace_alternative(member, i);
          std::visit([&](auto& alternative) { self(self, alternative); }, member);
        }
      } else if constexpr (std::is_class_v<T> && !std::is_same_v<T, std::string> &&
                           !std::is_same_v<T, std::vector<double>>) {
        self(self, member);
      }
    };
    fields(visit, spec);
  };
  scene::SceneSpec scene;
  check(check, scene);
  pile::PileSpec pile;
  check(check, pile);
  scene::RecordSpec record;
  check(check, record);
}

}  // namespace
}  // namespace seapile::study
