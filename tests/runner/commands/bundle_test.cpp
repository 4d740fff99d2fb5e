// `runner export --bundle` and `runner run --from`: a run goes to somebody else as one file, who repeats it to the bit
// or is told why not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "runner/execute/provenance.h"
#include "runner/execute/repetition.h"
#include "runner/store/bed_file.h"
#include "runner/store/bundle.h"
#include "runner/store/sealed_text.h"
#include "runner/store/sha256.h"
#include "tests/runner/commands/program.h"
#include "tests/runner/commands/tar_members.h"
#include "tests/runner/store/scratch.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kStudy = R"({
  "study": "small", "question": "How much does it resist?",
  "base": {
    "bed": {"domain": {"width": "0.8 m", "height": "1.5 m"},
            "grains": {"count": 80, "radius": {"min": "0.02 m", "max": "0.03 m"}}},
    "pile": {"radius": "0.05 m", "depth": "0.1 m", "driving": {"constant": {"speed": "0.4 m/s"}}},
    "fluid": null},
  "record": {"frames": ["0 m", "0.1 m"]}
})";

/// A drive in a bed, run and exported once for all tests: "drive.tar".
struct Bundle : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    *id = place->run_study("small", kStudy).front();
    ASSERT_EQ(place->run({"export", "--bundle", *id, "-o", "drive.tar"}).exit_code, 0);
    fs::create_directory(place->folder() / "scratch");
    ::setenv("TMPDIR", (place->folder() / "scratch").c_str(), 1);
  }
  static void TearDownTestSuite() {
    ::unsetenv("TMPDIR");
    delete place;
  }

  static Members members() { return members_of(content(place->folder() / "drive.tar")); }
  static Finished repeat(const std::string& tar, const std::string& store) {
    place->write("other.tar", tar);
    return place->run({"run", "--from", "other.tar", "--store", store});
  }
  /// A bundle that cannot be taken: one line that says so, and nothing else on the disk than before.
  static void expect_refused(const std::string& tar, const std::string& why) {
    place->write("other.tar", tar);
    place->write("out", "");
    place->write("error", "");
    auto before = everything(place->folder());
    const Finished refused = place->run({"run", "--from", "other.tar", "--store", "nowhere"});
    EXPECT_EQ(refused.exit_code, 2) << why;
    EXPECT_THAT(refused.error, AllOf(HasSubstr("other.tar"), HasSubstr(why), Not(HasSubstr("scratch"))));
    EXPECT_EQ(std::ranges::count(refused.error, '\n'), 1) << refused.error;
    EXPECT_THAT(refused.out, IsEmpty());
    place->write("error", "");
    EXPECT_EQ(everything(place->folder()), before) << why;
    EXPECT_TRUE(fs::is_empty(place->folder() / "scratch")) << why;
    EXPECT_FALSE(fs::exists(place->folder() / "nowhere")) << why;
  }
  static void expect_refused(const Members& members, const std::string& why) { expect_refused(tar_of(members), why); }

  static inline Workplace* place = nullptr;
  static inline std::string* id = new std::string;
};

TEST_F(Bundle, TheSameRunIsTheSameBytes) {
  EXPECT_EQ(place->run({"export", "--bundle", *id + "/1", "-o", "twice.tar"}).exit_code, 0);
  EXPECT_EQ(content(place->folder() / "twice.tar"), content(place->folder() / "drive.tar"));
  EXPECT_GT(content(place->folder() / "drive.tar").size(), 10'000u);
}

TEST_F(Bundle, AFileThatIsThereIsWrittenOverOnlyByForce) {
  place->write("taken.tar", "mine");
  const Finished refused = place->run({"export", "--bundle", *id, "-o", "taken.tar"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error, HasSubstr("taken.tar is there already"));
  EXPECT_EQ(content(place->folder() / "taken.tar"), "mine");
  EXPECT_EQ(place->run({"export", "--bundle", *id, "-o", "taken.tar", "--force"}).exit_code, 0);
  EXPECT_EQ(content(place->folder() / "taken.tar"), content(place->folder() / "drive.tar"));
  fs::create_symlink("taken.tar", place->folder() / "link.tar");
  for (const char* other : {"link.tar", "scratch"})
    EXPECT_THAT(place->run({"export", "--bundle", *id, "-o", other, "--force"}).error, HasSubstr("is no plain file"));
  EXPECT_TRUE(fs::is_symlink(place->folder() / "link.tar"));
  EXPECT_EQ(place->run({"export", "--bundle", "ffffffff", "-o", "none.tar"}).exit_code, 4);
  EXPECT_EQ(place->run({"export", "--bundle", *id, "-o", "no/folder.tar"}).exit_code, 2);
  EXPECT_EQ(place->run({"export", "--bundle", *id}).exit_code, 2);
  EXPECT_THAT(place->run({"export", "--help"}).out, HasSubstr("Examples"));
}

TEST_F(Bundle, AnUnpackedBundleIsAStoreInWhichEverySealHolds) {
  EXPECT_EQ(place->run({"export", "--bundle", *id, "-o", "fields.tar", "--with-fields"}).exit_code, 0);
  const store::Scratch scratch;
  for (const auto& [file, frames] : {std::pair{"drive.tar", 0u}, std::pair{"fields.tar", 2u}}) {
    const fs::path folder = scratch.fresh(file);
    const store::Bundle bundle = store::read_bundle(place->folder() / file, folder);
    EXPECT_THAT(store::verify(bundle.run.folder), IsEmpty());
    EXPECT_THAT(store::verify(bundle.bed->folder), IsEmpty());
    EXPECT_EQ(store::frame_count(bundle.run.folder), frames) << file;
    EXPECT_GT(store::read_series(bundle.run.folder).size(), 5u);
    EXPECT_EQ(place->run({"verify", "--store", folder.string()}).exit_code, 0);
  }
}

TEST_F(Bundle, ADamagedRunIsNotBundled) {
  fs::copy(place->results(), place->folder() / "damaged", fs::copy_options::recursive);
  const std::string part = *id;
  for (const auto& entry : fs::recursive_directory_iterator(place->folder() / "damaged")) {
    if (entry.path().filename() != "series.h5") continue;
    std::string bytes = content(entry.path());
    bytes[bytes.size() / 2] ^= 1;
    place->write(fs::relative(entry.path(), place->folder()).string(), bytes);
    const Finished refused = place->run({"export", "--bundle", part, "-o", "bad.tar", "--store", "damaged"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.error, HasSubstr("series.h5 has another SHA-256"));
    fs::remove(entry.path());
    EXPECT_THAT(place->run({"export", "--bundle", part, "-o", "bad.tar", "--store", "damaged"}).error,
                HasSubstr("series.h5 is missing"));
    break;
  }
  for (const auto& entry : fs::directory_iterator(place->folder()))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("bad.tar")));
}

TEST_F(Bundle, ARepetitionHasTheSameBitsAndIsReallyComputed) {
  const Finished same = place->run({"run", "--from", "drive.tar"});
  EXPECT_EQ(same.exit_code, 0) << same.error;
  EXPECT_THAT(same.out, AllOf(HasSubstr("bed   "), HasSubstr("drive " + *id + "  same: final state ")));
  EXPECT_EQ(std::ranges::count(same.out, '\n'), 2) << same.out;
  EXPECT_THAT(same.error, AllOf(HasSubstr("completed  bed"), HasSubstr("completed  case " + *id)));
  EXPECT_EQ(place->run({"compare", *id, *id, "--with-store", "again", "--expect-equal"}).exit_code, 0);
  // What it has made counts once more where the program has a commit to be known by, and never the bundled run itself.
  const Finished second = place->run({"run", "--from", "drive.tar"});
  const bool known = !execute::provenance().dirty && execute::provenance().commit != "unknown";
  EXPECT_EQ(second.exit_code, known ? 0 : 2) << second.error;
  EXPECT_THAT(known ? second.out : second.error,
              HasSubstr(known ? "same: final state" : "cannot stand for a repetition"));
  const Finished itself = place->run({"run", "--from", "drive.tar", "--store", "results"});
  EXPECT_EQ(itself.exit_code, 2);
  EXPECT_THAT(itself.error, HasSubstr("it is the bundled run itself"));
}

TEST_F(Bundle, AnotherStateIsSaidWithWhatIsKnownToDiffer) {
  Members forged = members();
  change_manifest(forged, "drive", [](store::Manifest& manifest) { manifest.result.state_hash ^= 1; });
  const Finished differs = repeat(tar_of(forged), "forged");
  EXPECT_EQ(differs.exit_code, 3) << differs.error;
  EXPECT_THAT(differs.error, HasSubstr("FAILED  the repetition is not the bundled run; nothing known differs"));
  EXPECT_THAT(differs.out, AllOf(HasSubstr("bed   "), HasSubstr("  same: final state "),
                                 HasSubstr("drive " + *id + "  different: final state "), HasSubstr(" was bundled, ")));
}

TEST_F(Bundle, ABedThatDiffersIsSaidToBeTheFirst) {
  Members forged = members();
  const store::Scratch scratch;
  Member& file = member(forged, "bed.h5");
  const fs::path at = scratch.path() / "bed.h5";
  place->write("bed.h5", file.bytes);
  change_manifest(forged, "bed", [&](store::Manifest& manifest) {
    const store::Stamp stamp{manifest.header.case_id, manifest.run};
    simulation::Bed bed = store::read_bed(place->folder() / "bed.h5", stamp);
    for (simulation::Array& array : bed.grains)
      if (array.info.name == "grains/position") std::get<std::vector<double>>(array.values)[0] *= 1 + 1e-15;
    store::write_bed(at, stamp, bed);
    file.bytes = content(at);
    for (store::FileEntry& entry : manifest.files)
      if (entry.path == "bed.h5") entry = {entry.path, file.bytes.size(), store::sha256(file.bytes)};
    manifest.provenance.compiler = "Another 1.0";
  });
  const Finished differs = repeat(tar_of(forged), "other_bed");
  EXPECT_EQ(differs.exit_code, 3) << differs.error;
  EXPECT_THAT(differs.error, AllOf(HasSubstr("the bed is the first to differ"),
                                   HasSubstr("known to differ of how both were made: compiler")));
  EXPECT_THAT(differs.out, AllOf(HasSubstr("  different: "), HasSubstr("another build (compiler)"),
                                 HasSubstr("drive " + *id + "  same: final state ")));
}

TEST_F(Bundle, WhatIsNoBundleIsRefused) {
  expect_refused(std::string(), "is no tar file");
  expect_refused(std::string(2000, 'x'), "is no tar file");
  expect_refused(std::string(4096, '\0'), "its first member is not bundle.json");
  const std::string whole = content(place->folder() / "drive.tar");
  for (const std::size_t bytes : {whole.size() / 5, whole.size() / 2, whole.size() * 9 / 10})
    expect_refused(whole.substr(0, bytes), "cut off");
  expect_refused(whole.substr(0, 700), "cut off");
  Members late = members();
  std::swap(late[0], late[1]);
  expect_refused(late, "its first member is not bundle.json");
  EXPECT_EQ(place->run({"run", "--from", "none.tar"}).exit_code, 2);
  EXPECT_EQ(place->run({"run", "--from", "."}).exit_code, 2);
  EXPECT_EQ(place->run({"run", "--from", "drive.tar", "--seeds", "2"}).exit_code, 2);
  EXPECT_EQ(place->run({"run", "small.json", "--from", "drive.tar"}).exit_code, 2);
  EXPECT_EQ(place->run({"run"}).exit_code, 2);
}

TEST_F(Bundle, AMemberThatTheIndexDoesNotAllowIsRefused) {
  const auto with = [](const Member& more) {
    Members changed = members();
    changed.push_back(more);
    return changed;
  };
  expect_refused(with({"more.txt", "x"}), "\"more.txt\" is not in bundle.json");
  expect_refused(with({"../evil", "x"}), "\"../evil\" has a name that leads out of the bundle");
  expect_refused(with({"cases/../../evil", "x"}), "leads out of the bundle");
  expect_refused(with({"/evil", "x"}), "\"/evil\" has an absolute name");
  expect_refused(with({"a\nb", "x"}), "\"a\\nb\" has a name with control characters");
  expect_refused(with({"evil", "", '2', "../x"}), "\"evil\" is a symbolic link");
  expect_refused(with({"evil", "", '1', "bundle.json"}), "\"evil\" is a hard link");
  expect_refused(with({"evil", "", '5'}), "is a directory");
  expect_refused(with({"evil", "", '3'}), "is a device");
  expect_refused(with({"evil", "", '6'}), "is a pipe");
  expect_refused(with(members().back()), "is there twice");
  expect_refused(with(members().front()), "is there twice");
  Members longer = members(), shorter = members(), flipped = members(), lost = members();
  longer.back().bytes += "x";
  expect_refused(longer, "bytes instead of");
  shorter.back().bytes.pop_back();
  expect_refused(shorter, "bytes instead of");
  flipped.back().bytes[100] ^= 1;
  expect_refused(flipped, "has another SHA-256 than bundle.json says");
  std::erase_if(lost, [](const Member& one) { return one.name.ends_with("dropped.json"); });
  expect_refused(lost, "dropped.json\" is missing: the file is cut off");
}

TEST_F(Bundle, AnIndexThatWouldLeadElsewhereIsRefused) {
  const auto indexed = [](auto change) {
    Members changed = members();
    change_index(changed, change);
    return changed;
  };
  const auto named = [&](const std::string& name) {
    return indexed([name](store::BundleIndex& index) { index.members.insert(index.members.begin(), {name, 1, ""}); });
  };
  expect_refused(named("../evil"), "\"../evil\" has a name that leads out of the bundle");
  expect_refused(named("/evil"), "\"/evil\" has an absolute name");
  expect_refused(named("catalogue.sqlite"), "\"catalogue.sqlite\" is of neither run");
  expect_refused(indexed([](auto& index) { index.members.push_back(index.members.back()); }), "does not come after");
  expect_refused(indexed([](auto& index) { index.members.back().bytes = 1'000'000'000'000; }),
                 "more bytes than the file");
  expect_refused(indexed([](auto& index) { index.run = "../1"; }), "it names no run");
  expect_refused(indexed([](auto& index) { index.bed_run = "0002"; }), "is of neither run");
  Members unsealed = members();
  unsealed.front().bytes[20] ^= 1;
  expect_refused(unsealed, "bundle.json is damaged: its seal is not that of its text");
  Members newer = members();
  json object = json::parse(newer.front().bytes);
  object.erase("seal");
  object["schema"] = 2;
  newer.front().bytes = store::with_seal(object.dump(2));
  expect_refused(newer, "bundle.json is of schema 2, newer than this program, which knows 1");
}

TEST_F(Bundle, ARunThatItsManifestDoesNotSayIsRefused) {
  const auto manifested = [](const std::string& kind, auto change) {
    Members changed = members();
    change_manifest(changed, kind, change);
    return changed;
  };
  Members other = members();
  member(other, "series.h5").bytes[5000] ^= 1;
  list_again(other);
  expect_refused(other, "series.h5\" is not what its manifest says");
  Members lost = members();
  std::erase_if(lost, [](const Member& one) { return one.name.ends_with("bed.h5"); });
  list_again(lost);
  expect_refused(lost, "bed.h5\" is missing, which its manifest lists");
  Members more = members();
  more.insert(more.begin() + 1, more[1]);
  more[1].name.replace(more[1].name.rfind('/') + 1, std::string::npos, "another.h5");
  list_again(more);
  expect_refused(more, "another.h5\" is in no manifest");
  Members broken = members();
  member(broken, "manifest.json").bytes[200] ^= 1;
  list_again(broken);
  expect_refused(broken, "manifest.json is damaged: its seal");
  expect_refused(manifested("drive", [](store::Manifest& m) { m.schema = 9; }), "it is of schema 9");
  expect_refused(manifested("drive", [](store::Manifest& m) { m.run = "0002"; }), "it is of run 0002");
  expect_refused(manifested("drive", [](store::Manifest& m) { m.header.bed_run = "0007"; }), "names another bed");
  expect_refused(manifested("drive", [](store::Manifest& m) { m.header.canonical += " "; }), "case with another id");
  const auto scene = [&](const char* path, const json& value) {
    return manifested("drive", [&](store::Manifest& m) {
      json changed = json::parse(m.header.scene_json);
      changed[json::json_pointer(path)] = value;
      m.header.scene_json = changed.dump();
    });
  };
  expect_refused(scene("/pile/radius", 0.06), "/case");
  expect_refused(scene("/pile/depth", 7.0), "/scene/pile/depth");
  expect_refused(scene("/pile/colour", "red"), "/scene/pile/colour");
}

TEST_F(Bundle, GrainsOfAFileGoAlong) {
  std::string grains = "id,x,y,radius\n";
  for (int i = 0; i < 8; ++i) grains += std::to_string(i) + "," + std::to_string(-0.35 + 0.1 * i) + ",0.05,0.04\n";
  const Workplace mine;
  mine.write("grains.csv", grains);
  const auto ids = mine.run_study("given", R"({
    "study": "given", "question": "How do they lie?", "base": {"pile": null, "fluid": null,
      "bed": {"domain": {"width": "0.9 m", "height": "0.6 m"}, "file": "grains.csv"}}})");
  ASSERT_EQ(mine.run({"export", "--bundle", ids.front(), "-o", "given.tar"}).exit_code, 0);
  Workplace yours;
  yours.write("given.tar", content(mine.folder() / "given.tar"));
  const Finished same = yours.run({"run", "--from", "given.tar"});
  EXPECT_EQ(same.exit_code, 0) << same.error;
  EXPECT_THAT(same.out, HasSubstr("same: final state"));
  // The repetition has its grains beside it, and is bundled without the file of the first one.
  EXPECT_EQ(yours.run({"export", "--bundle", ids.front(), "-o", "on.tar", "--store", "again"}).exit_code, 0);
  Members other = members_of(content(mine.folder() / "given.tar"));
  member(other, ".csv").bytes.replace(std::string("id,x,y,radius\n0,-0.3").size(), 1, "6");
  list_again(other);
  yours.write("given.tar", tar_of(other));
  const Finished refused = yours.run({"run", "--from", "given.tar", "--store", "nowhere"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error, HasSubstr("/scene/bed/file"));
  mine.write("grains.csv", grains + "8,0,0.3,0.04\n");
  EXPECT_EQ(mine.run({"export", "--bundle", ids.front(), "-o", "changed.tar"}).exit_code, 2);
}

TEST_F(Bundle, WhatDivergedIsRepeatedToTheSameEnd) {
  const Workplace mine;
  mine.write("steep.json", R"({"study": "steep", "question": "How steep?", "record": {"interval": 0.05},
    "base": {"basin": {"surface": {"scheme": "galerkin", "initial": {"cosine": {"amplitude": 0.1}}},
      "mesh": {"pattern": {"structured": {"columns": 16, "rows": 4}}}, "time": {"step": 0.05, "duration": 20}}}})");
  ASSERT_EQ(mine.run({"steep.json"}).exit_code, 1);
  const std::string steep =
      json::parse(mine.run({"query", "steep", "--format", "json"}).out).at("rows").at(0).at("case");
  ASSERT_EQ(mine.run({"export", "--bundle", steep, "-o", "steep.tar"}).exit_code, 0);
  const Finished same = mine.run({"run", "--from", "steep.tar"});
  EXPECT_EQ(same.exit_code, 0) << same.error;
  EXPECT_THAT(same.out, HasSubstr("flow  " + steep + "  same: final state "));
  EXPECT_THAT(same.error, HasSubstr("diverged: the surface is too steep"));
}

TEST(Repetition, OnlyWhatThisProgramMadeIsOne) {
  store::Manifest run, bundled;
  store::Provenance today;
  today.commit = "1a2b3c";
  run.provenance = today;
  run.seal = "a", bundled.seal = "b";
  EXPECT_EQ(execute::why_no_repetition(run, bundled, today), "");
  bundled.seal = "a";
  EXPECT_THAT(execute::why_no_repetition(run, bundled, today), HasSubstr("the bundled run itself"));
  bundled.seal = "b";
  run.provenance.threads = 7, run.provenance.simd = "generic";
  EXPECT_EQ(execute::why_no_repetition(run, bundled, today), "");
  run.provenance.compiler = "Another 1.0", run.provenance.host_cpu = "Another";
  EXPECT_THAT(execute::why_no_repetition(run, bundled, today), HasSubstr("(compiler, processor)"));
  run.provenance = today;
  today.dirty = run.provenance.dirty = true;
  EXPECT_THAT(execute::why_no_repetition(run, bundled, today), HasSubstr("no commit names"));
}

}  // namespace
}  // namespace seapile::commands
