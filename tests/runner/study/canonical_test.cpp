#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "runner/study/field_reader.h"
#include "runner/study/sha256.h"
#include "runner/study/study.h"

namespace seapile::study {
namespace {

std::string id_of(const scene::SceneSpec& scene) {
  return case_id(canonical_text(scene, case_id(canonical_text(scene.bed))));
}

/// Any value that a field list allows, for every member.
class AnyValue {
 public:
  explicit AnyValue(unsigned seed) : random_(seed) {}

  template <class Spec>
  void fill(Spec& spec) {
    const auto visit = [&](const base::Field& field, auto& member) { fill_member(field, member); };
    fields(visit, spec);
  }

 private:
  double share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  double number(const base::Range& range) {
    const double low = std::max(range.min, -1e6), high = std::min(range.max, 1e6);
    // Short decimals, long ones, and the ends.
    const double any = low + (high - low) * share();
    const double candidates[] = {any, std::round(any * 100) / 100, low, high,
                                 low + (high - low) * std::pow(share(), 20)};
    const double value = candidates[random_() % 5];
    return range.contains(value) ? value : any;
  }

  template <class T>
  void fill_member(const base::Field& field, T& member) {
    if constexpr (std::is_same_v<T, double>) {
      member = number(field.range);
    } else if constexpr (std::is_same_v<T, bool>) {
      member = random_() % 2 == 0;
    } else if constexpr (std::is_integral_v<T>) {
      const double any = std::floor(number(field.range));
      member = static_cast<T>(field.range.contains(any) ? any : std::ceil(field.range.min));
    } else if constexpr (std::is_enum_v<T>) {
      member = static_cast<T>(random_() % enum_names<T>().size());
    } else if constexpr (std::is_same_v<T, std::string>) {
      constexpr const char* kTexts[] = {"", "grains.csv", "/a b/\"ü\"/\\x.csv", "橋/é.csv"};
      member = kTexts[random_() % 4];
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      member.resize(random_() % 5);
      for (double& element : member) element = number(field.range);
    } else if constexpr (kIsOptional<T>) {
      member.reset();
      if (random_() % 3 != 0) fill_member(field, member.emplace());
    } else if constexpr (kIsVariant<T>) {
      emplace_alternative(member, random_() % std::variant_size_v<T>);
      std::visit([&](auto& alternative) { fill(alternative); }, member);
    } else {
      fill(member);
    }
  }

  std::mt19937_64 random_;
};

TEST(Canonical, AnySceneComesBackFromItsJson) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    scene::SceneSpec scene;
    AnyValue(seed).fill(scene);
    if (is_water(scene)) {  // which is handed over alone
      scene::SceneSpec alone;
      alone.jet = scene.jet;
      alone.model = scene.model;
      if (!scene.jet) alone.basin = scene.basin;
      scene = alone;
    }
    if (!scene.bed.file.empty()) scene.bed.file_content = sha256(scene.bed.file);
    const std::string text = to_json(scene);
    const scene::SceneSpec back = scene_from_json(text);
    ASSERT_EQ(back, scene) << text;
    ASSERT_EQ(to_json(back), text);
    ASSERT_EQ(id_of(back), id_of(scene));
  }
}

TEST(Canonical, AJetIsKnownByItselfAlone) {
  scene::SceneSpec scene;
  scene.jet.emplace();
  const std::string text = canonical_text(scene, "");
  EXPECT_EQ(text,
            R"({"jet":{"capillary":null,"downstream":20,"geometry":"axisymmetric","growth":0.15,"largest_size":0.2,)"
            R"("lip_size":0.01,"method":{"steady":{}},"reynolds":24,"upstream":3.5}})");
  scene.bed.seed = 7;
  scene.contact.step = 1e-4;
  EXPECT_EQ(canonical_text(scene, ""), text);
}

// The ids of stored basins hang on this text and on this hash.
TEST(Canonical, ABasinIsKnownByItselfAlone) {
  scene::SceneSpec scene;
  basin::BasinSpec& basin = scene.basin.emplace();
  const std::string text = canonical_text(scene, "");
  EXPECT_EQ(text,
            R"({"basin":{"bottom":"slip","density":1000,"depth":0.25,"gravity":9.81,"mesh":{"motion":{"vertical":{}},)"
            R"("pattern":{"structured":{"bottom_row":1,"columns":192,"rows":24}},"remesh":null},"pile":null,)"
            R"("surface":{"initial":{"flat":{}},"scheme":"conservative","tension":0,"volume_correction":false},)"
            R"("time":{"duration":1,"iterated":true,"order":2,"rate":null,"step":0.001,"tolerance":1e-09},)"
            R"("viscosity":0.001,"walls":"slip","width":1}})");
  EXPECT_EQ(case_id(text), "432a2b59a18b21c93a4f82d19e318e6c5254baa3626f4077d3f04f607eed6fac");
  scene.bed.seed = 7;
  scene.contact.step = 1e-4;
  EXPECT_EQ(canonical_text(scene, ""), text);

  basin.pile.emplace();
  basin.mesh = {basin::UnstructuredMesh{}, basin::ZonesMotion{}, basin::RemeshSpec{}};
  basin.surface->initial = basin::CosineSurface{};
  EXPECT_EQ(case_id(canonical_text(scene, "")), "539c2348f59dd357da0f019ad63fca6b78ee72ed3e99225d9612d7a311a3f719")
      << canonical_text(scene, "");
}

// A scene that was stored before there was water has kept its name.
TEST(Canonical, WaterThatIsNotThereChangesNoId) {
  scene::SceneSpec scene;
  scene.pile.emplace();
  const std::string text = canonical_text(scene, "00");
  EXPECT_EQ(text.find("basin"), std::string::npos);
  EXPECT_EQ(text.find("jet"), std::string::npos);
  const std::string record = canonical_text(scene::RecordSpec{});
  EXPECT_EQ(record, R"({"frames":[0,0.2,0.6,1.2],"spacing":0.05,"travel":5e-04,"window":0.01})");
}

TEST(Canonical, ARecordIsWhatTheSceneHeedsOfIt) {
  scene::RecordSpec record;
  record.travel = 1e-3;
  record.interval = 0.5;
  record.times = {1, 2};
  scene::SceneSpec drive, basin;
  drive.pile.emplace();
  basin.basin.emplace();
  EXPECT_EQ(to_json(record, drive), R"({"frames":[0,0.2,0.6,1.2],"spacing":0.05,"travel":0.001,"window":0.01})");
  EXPECT_EQ(to_json(record, basin), R"({"interval":0.5,"times":[1,2]})");
  EXPECT_EQ(record_of(record, basin).travel, scene::RecordSpec{}.travel);
  EXPECT_EQ(record_of(record, basin).times, record.times);
  EXPECT_EQ(record_of(record, drive).interval, scene::RecordSpec{}.interval);
}

TEST(Canonical, AnyRecordComesBackFromItsJson) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    scene::RecordSpec record;
    AnyValue(seed).fill(record);
    ASSERT_EQ(record_from_json(to_json(record)), record) << to_json(record);
    ASSERT_EQ(canonical_text(record_from_json(canonical_text(record))), canonical_text(record));
  }
}

TEST(Canonical, ReadingTheTextAndWritingItAgainChangesNothing) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    scene::BedSpec bed;
    AnyValue(seed).fill(bed);
    const std::string text = canonical_text(bed);
    const scene::SceneSpec back = scene_from_json("{\"bed\":" + text + "}");
    ASSERT_EQ(canonical_text(back.bed), text);
  }
}

TEST(Canonical, IsJsonWithSortedKeysAndNoSpaces) {
  scene::SceneSpec scene;
  scene.pile.emplace();
  for (const std::string& text :
       {canonical_text(scene.bed), canonical_text(scene, "00"), canonical_text(scene::RecordSpec{})}) {
    // A nlohmann::json object is sorted by key, whatever the order it was read in.
    auto keys = [](const nlohmann::ordered_json& object) {
      std::vector<std::string> names;
      for (const auto& [key, value] : object.items()) names.push_back(key);
      return names;
    };
    const auto names = keys(nlohmann::ordered_json::parse(text));
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end())) << text;
    EXPECT_EQ(text.find(' '), std::string::npos) << text;
  }
}

TEST(Canonical, TextOfTheDefaultBed) {
  EXPECT_EQ(
      canonical_text(scene::BedSpec{}),
      R"({"domain":{"gravity":9.81,"height":4,"width":5},"file_content":"",)"
      R"("grains":{"count":11596,"density":1500,"friction":{"grain":0.5,"wall":0},"radius":{"max":0.0192,"min":0.0112},"restitution":0},)"
      R"("preparation":{"contact":{"damping":10,"precision":"single","step":5e-04,"stiffness":0.125,"substeps":10},"longest":12,"solid_fraction":null,"tolerance":0.001},)"
      R"("seed":1})");
}

TEST(Canonical, TextOfTheDefaultPileInABed) {
  scene::SceneSpec scene;
  scene.pile.emplace();
  EXPECT_EQ(
      canonical_text(scene, "b3d"),
      R"({"bed":"b3d","contact":{"damping":10,"precision":"single","step":5e-04,"stiffness":0.125,"substeps":10},"fluid":null,)"
      R"("pile":{"depth":1.2,"driving":{"constant":{"speed":0.06}},"duration":null,"friction":0.5,"radius":0.125,)"
      R"("tip":{"conical":{"apex_angle":1.0471975511965976}}}})");
}

TEST(Canonical, TextOfTheDefaultFluid) {
  scene::SceneSpec scene;
  scene.pile.emplace();
  scene.fluid.emplace();
  const std::string text = canonical_text(scene, "b3d");
  EXPECT_NE(text.find(R"("fluid":{"bottom":"slip")"), std::string::npos) << text;
  EXPECT_EQ(scene_from_json(to_json(scene)), scene);
  EXPECT_EQ(canonical_text(scene.bed), canonical_text(scene::BedSpec{})) << "what is poured on a bed changes no bed";
}

// These ids stand in every catalogue that exists: a change of this test loses every result that was ever kept.
TEST(Canonical, IdsAreForEver) {
  scene::SceneSpec scene;
  EXPECT_EQ(case_id(canonical_text(scene.bed)), "a848e9e239d45083a7d46cb422b1a2e470617a7fc95c55740119d75b1aec5c65");
  scene.pile.emplace();
  EXPECT_EQ(id_of(scene), "f7a7a22d0707a686a98acf0ebbff4cbe74f4928ea17c3493f2223b125c068efa");
  scene.pile->tip = pile::FlatTip{};
  EXPECT_EQ(id_of(scene), "83fed6e98ef470020a00b63a5d41a0731b5b2765c1e5044b027ac23e32c02f47");
  scene.bed.preparation.solid_fraction = 0.82;
  EXPECT_EQ(case_id(canonical_text(scene.bed)), "bbeb67e62655bc821cb06f41c9dcd9a3dc32dc800a588200fe4efe77015a8377");
  EXPECT_EQ(id_of(scene), "f5247bf456abd1ae937fda85f01fd1e26cd8a0c455181115d3ef1a34739d6058");
  scene = {};
  scene.pile.emplace();
  scene.fluid.emplace();
  EXPECT_EQ(id_of(scene), "ab5c2e42ce38593bd7db6957f1f573393a0c559f893d64946e99262609209705");
}

// The ids above were given before there was a choice of method and solver.
TEST(Canonical, AFieldAddedLaterIsLeftOutWhileItHoldsItsDefault) {
  scene::SceneSpec scene;
  scene.pile.emplace();
  EXPECT_EQ(canonical_text(scene, "bed").find("method"), std::string::npos);
  EXPECT_EQ(canonical_text(scene, "bed").find("solver"), std::string::npos);
  scene.contact.method = grains::NonSmoothMethod{};
  scene.contact.solver = grains::Solver::brute_force;
  const std::string text = canonical_text(scene, "bed");
  EXPECT_NE(text.find(R"("method":{"nonsmooth":{"correction":0.001,"sweeps":100,"tolerance":0}})"), std::string::npos)
      << text;
  EXPECT_NE(text.find(R"("solver":"brute_force")"), std::string::npos) << text;
  EXPECT_EQ(scene_from_json(to_json(scene)), scene);
}

// What a method does not have is no part of the case: it could make two names for one result.
TEST(Canonical, MembersOfTheOtherMethodAreNoPartOfACase) {
  scene::SceneSpec soft, rigid;
  soft.pile.emplace();
  rigid = soft;
  rigid.contact.method = grains::NonSmoothMethod{};
  const std::string id_soft = id_of(soft), id_rigid = id_of(rigid);
  soft.contact.damping = rigid.contact.damping = 5;
  EXPECT_NE(id_of(soft), id_soft);
  EXPECT_EQ(id_of(rigid), id_rigid);
}

TEST(Canonical, ACaseIsItsBedAndWhatIsDoneToIt) {
  scene::SceneSpec scene;
  scene.pile.emplace();
  scene::SceneSpec other_bed = scene;
  other_bed.bed.seed = 2;
  EXPECT_NE(id_of(other_bed), id_of(scene));
  scene::SceneSpec other_solver = scene;
  other_solver.contact.substeps = 20;
  EXPECT_NE(id_of(other_solver), id_of(scene));
  EXPECT_EQ(canonical_text(other_solver.bed), canonical_text(scene.bed));
}

TEST(Canonical, WithoutAPileTheCaseIsTheBed) {
  scene::SceneSpec scene;
  EXPECT_EQ(id_of(scene), case_id(canonical_text(scene.bed)));
}

TEST(Canonical, AGrainFileIsKnownByItsGrainsAndNotByItsPlace) {
  scene::BedSpec here, there, other;
  here.file = "/here/grains.csv";
  there.file = "/there/same.csv";
  other.file = "/here/grains.csv";
  here.file_content = there.file_content = std::string(64, 'a');
  other.file_content = std::string(64, 'b');
  EXPECT_EQ(canonical_text(here), canonical_text(there));
  EXPECT_NE(canonical_text(here), canonical_text(other));
}

TEST(Canonical, MinusZeroIsZero) {
  scene::BedSpec plus, minus;
  minus.grains.friction.wall = -0.0;
  EXPECT_EQ(canonical_text(minus), canonical_text(plus));
}

TEST(Canonical, WhatIsNotFiniteIsOurOwnMistake) {
  scene::BedSpec bed;
  bed.grains.density = std::nan("");
  EXPECT_THROW(canonical_text(bed), std::logic_error);
}

TEST(SceneFromJson, RefusesWhatToJsonDoesNotWrite) {
  for (const char* text :
       {"", "[]", "{\"pile\":{\"radius\":-1}}", "{\"bed\":{\"file_content\":7}}", "{\"bedd\":{}}", "{} {}"}) {
    EXPECT_THROW(scene_from_json(text), BadInput) << text;
    EXPECT_THROW(record_from_json(text), BadInput) << text;
  }
}

TEST(Sha256, IsTheStandardsOne) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace seapile::study
