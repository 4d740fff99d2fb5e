#include "runner/store/hdf5_file.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>

#include "runner/store/durable.h"
#include "runner/store/run_folder.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store::hdf5 {
namespace {

using Integers = std::vector<std::int64_t>;

class Hdf5File : public testing::TestWithParam<Storage> {
 protected:
  Scratch scratch_;
  std::filesystem::path file_ = scratch_.path() / "file.h5";
};

TEST_P(Hdf5File, GivesBackWhatWasWritten) {
  const std::vector<double> reals = {0.1, -0.0, 1e300, 5e-324, -1e-17, 3};
  const std::vector<float> floats = {0.1F, 2};
  const std::vector<std::int32_t> small = {-1, 2147483647};
  const Integers wide = {-9'223'372'036'854'775'807LL - 1, 7};
  const std::vector<std::uint64_t> hashes = {0xfedcba9876543210U};
  const std::vector<std::uint8_t> bytes = {0, 255, 9};
  FileWriter writer(file_, GetParam());
  writer.dataset("/a/deep/path", {2, 3}, reals);
  writer.dataset("/floats", {2, 0}, floats);
  writer.dataset("/small", {2, 0}, small);
  writer.dataset("/wide", {2, 0}, wide);
  writer.dataset("/hashes", {1, 0}, hashes);
  writer.dataset("/bytes", {3, 0}, bytes);
  writer.attribute("/a", "text", "caf\u00e9 [m/s]");
  writer.attribute("/", "nothing", "");
  writer.attribute("/floats", "number", std::int64_t{-3});
  writer.attribute("/floats", "list", Integers{2, 0});
  writer.close();

  FileReader reader(file_);
  EXPECT_EQ(reader.read<double>("/a/deep/path"), reals);
  EXPECT_TRUE(std::signbit(reader.read<double>("/a/deep/path")[1]));
  EXPECT_EQ(reader.extents("/a/deep/path"), (Extents{2, 3}));
  EXPECT_EQ(reader.read<float>("/floats"), floats);
  EXPECT_EQ(reader.read<std::int32_t>("/small"), small);
  EXPECT_EQ(reader.read<std::int64_t>("/wide"), wide);
  EXPECT_EQ(reader.read<std::uint64_t>("/hashes"), hashes);
  EXPECT_EQ(reader.read<std::uint8_t>("/bytes"), bytes);
  EXPECT_EQ(reader.attribute<std::string>("/a", "text"), "caf\u00e9 [m/s]");
  EXPECT_EQ(reader.attribute<std::string>("/", "nothing"), "");
  EXPECT_EQ(reader.attribute<std::int64_t>("/floats", "number"), -3);
  EXPECT_EQ(reader.attribute<Integers>("/floats", "list"), (Integers{2, 0}));
  EXPECT_EQ(reader.datasets("/a"), std::vector<std::string>{"/a/deep/path"});
  EXPECT_EQ(reader.datasets("/nowhere/else"), std::vector<std::string>{});
  EXPECT_EQ(reader.datasets("/").size(), 6U);
  reader.close();
}

TEST_P(Hdf5File, HoldsDatasetsWithoutARow) {
  FileWriter writer(file_, GetParam());
  writer.dataset("/flat", {0, 0}, std::vector<double>{});
  writer.dataset("/pairs", {0, 2}, Integers{});
  writer.window("/window", "/pairs", 0, {0, 2}, 0x2d06800538d394c2U);  // XXH3 of nothing.
  writer.close();
  FileReader reader(file_);
  EXPECT_TRUE(reader.read<double>("/flat").empty());
  EXPECT_TRUE(reader.read<std::int64_t>("/pairs").empty());
  EXPECT_TRUE(reader.read<std::int64_t>("/window").empty());
  EXPECT_EQ(reader.extents("/window"), (Extents{0, 2}));
  reader.close();
}

TEST_P(Hdf5File, IsFilledPieceByPieceAndSeenThroughWindows) {
  FileWriter writer(file_, GetParam());
  const Integers first = {1, 2, 3, 4}, second = {5, 6};
  writer.create("/pairs", Number::i64, {3, 2});
  const auto first_hash = writer.append("/pairs", std::span<const std::int64_t>(first));
  const auto second_hash = writer.append("/pairs", std::span<const std::int64_t>(second));
  writer.window("/steps/0", "/pairs", 0, {2, 2}, first_hash);
  writer.window("/steps/1", "/pairs", 2, {1, 2}, second_hash);
  writer.close();
  FileReader reader(file_);
  EXPECT_EQ(reader.read<std::int64_t>("/pairs"), (Integers{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(reader.read<std::int64_t>("/steps/0"), first);
  EXPECT_EQ(reader.read<std::int64_t>("/steps/1"), second);
  reader.close();
}

TEST_P(Hdf5File, HasWindowsThatShareValuesOutInRowsOfTheirOwn) {
  // Enough of them that a window begins and ends within chunks.
  Integers values(90'000);
  std::iota(values.begin(), values.end(), 7);
  FileWriter writer(file_, GetParam());
  writer.create("/corners", Number::i64, {values.size(), 0});
  const std::span<const std::int64_t> all(values);
  const auto first = writer.append("/corners", all.first(30'000)),
             second = writer.append("/corners", all.subspan(30'000));
  writer.window("/steps/0", "/corners", 0, {10'000, 3}, first);
  writer.window("/steps/1", "/corners", 30'000, {20'000, 3}, second);
  writer.close();
  FileReader reader(file_);
  EXPECT_EQ(reader.extents("/steps/1"), (Extents{20'000, 3}));
  EXPECT_EQ(reader.read<std::int64_t>("/steps/0"), Integers(values.begin(), values.begin() + 30'000));
  EXPECT_EQ(reader.read<std::int64_t>("/steps/1"), Integers(values.begin() + 30'000, values.end()));
  reader.close();
}

TEST_P(Hdf5File, OfTheSameContentHasTheSameBytes) {
  // Nothing in it says when: the library would otherwise keep the time of creation of every object.
  FileWriter writer(file_, GetParam());
  writer.dataset("/group/data", {1, 0}, std::vector<double>{1});
  writer.close();
  const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  for (const char* object : {"/", "/group", "/group/data"}) {
    H5O_info_t info;
    ASSERT_GE(H5Oget_info_by_name2(file, object, &info, H5O_INFO_TIME, H5P_DEFAULT), 0);
    EXPECT_EQ(info.mtime, 0) << object;
  }
  H5Fclose(file);
}

INSTANTIATE_TEST_SUITE_P(Storages, Hdf5File, testing::Values(Storage::plain, Storage::packed),
                         [](const auto& i) { return i.param == Storage::plain ? "plain" : "packed"; });

TEST(Hdf5Writer, DoesNotTouchAFileThatIsThere) {
  // The library would empty the file of another process before it looks at its lock.
  const Scratch scratch;
  const auto file = scratch.path() / "file.h5";
  write_text(file, "another's");
  EXPECT_THROW(FileWriter(file, Storage::plain), StoreError);
  EXPECT_EQ(read_text(file), "another's");
}

TEST(Hdf5Writer, RefusesWhatDoesNotFit) {
  const Scratch scratch;
  const auto attempt = [&](const auto& what) {
    FileWriter writer(scratch.fresh("x") / "file.h5", Storage::plain);
    writer.create("/data", Number::f64, {2, 2});
    what(writer);
    writer.close();
  };
  const std::vector<double> row = {1, 2};
  EXPECT_THROW(attempt([&](auto&) {}), std::logic_error);  // Not filled.
  EXPECT_THROW(attempt([&](auto& w) {
                 for (int i = 0; i < 3; ++i) w.append("/data", std::span<const double>(row));
               }),
               std::logic_error);
  EXPECT_THROW(attempt([&](auto& w) { w.append("/data", std::span<const double>(row).first(1)); }), std::logic_error);
  EXPECT_THROW(attempt([&](auto& w) { w.append("/data", std::span<const float>()); }), std::logic_error);
  EXPECT_THROW(attempt([&](auto& w) { w.append("/other", std::span<const double>(row)); }), std::logic_error);
  const auto attempt_window = [&](std::uint64_t first, Extents extents) {
    attempt([&](auto& w) {
      for (int i = 0; i < 2; ++i) w.append("/data", std::span<const double>(row));
      w.window("/part", "/data", first, extents, 0);
    });
  };
  EXPECT_NO_THROW(attempt_window(1, {1, 2}));
  EXPECT_THROW(attempt_window(0, {1, 3}), std::logic_error);
  EXPECT_THROW(attempt_window(1, {2, 2}), std::logic_error);
}

TEST(Hdf5Reader, RefusesAnotherTypeAndMissingThings) {
  const Scratch scratch;
  const auto file = scratch.path() / "file.h5";
  FileWriter writer(file, Storage::plain);
  writer.dataset("/data", {1, 0}, std::vector<double>{7});
  writer.close();
  const auto attempt = [&](const auto& what) {
    FileReader reader(file);
    what(reader);
    reader.close();
  };
  EXPECT_THROW(attempt([](auto& r) { r.template read<float>("/data"); }), StoreError);
  EXPECT_THROW(attempt([](auto& r) { r.template read<double>("/none"); }), StoreError);
  EXPECT_THROW(attempt([](auto& r) { r.any_attribute("/data", "none"); }), StoreError);
  EXPECT_THROW(attempt([](auto& r) { r.template attribute<std::string>("/data", "xxh3"); }), StoreError);
  EXPECT_THROW(FileReader(scratch.path() / "none.h5"), StoreError);
}

TEST(Hdf5Reader, NoticesValuesThatAreNotThoseWritten) {
  const Scratch scratch;
  const auto file = scratch.path() / "file.h5";
  FileWriter writer(file, Storage::plain);
  writer.dataset("/data", {1, 0}, std::vector<double>{7});
  writer.close();
  // A plain dataset has no checksum of the library's own.
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t data = H5Dopen2(opened, "/data", H5P_DEFAULT);
  const double other = 8;
  ASSERT_GE(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &other), 0);
  H5Dclose(data);
  H5Fclose(opened);
  FileReader reader(file);
  try {
    reader.read<double>("/data");
    ADD_FAILURE();
  } catch (const StoreError& error) {
    EXPECT_EQ(error.kind, StoreError::Kind::damaged);
  }
  reader.close();
}

TEST(Hdf5Reader, RefusesAFileWithAPieceThatReadsAsZeros) {
  // More names in a group than its header holds. What the library does not set in its memory is no zero there.
  constexpr std::size_t kPiece = 64;
  const Scratch scratch;
  const std::filesystem::path file = scratch.path() / "file.h5";
  std::map<std::string, std::vector<double>> written;
  for (int i = 0; i < 20; ++i) written["/group/name_" + std::to_string(i)] = {0.5 + i, 1};
  FileWriter writer(file, Storage::plain);
  for (const auto& [name, values] : written) writer.dataset(name, {2, 0}, values);
  writer.close();
  const std::string whole = read_text(file);
  // In a process of its own, which has read nothing yet: 0 read rightly, 1 refused, 2 wrong.
  const auto in_child = [&] {
    ::mallopt(M_PERTURB, 0xA5);
    try {
      FileReader reader(file);
      const std::vector<std::string> found = reader.datasets("/");
      bool right = found.size() == written.size();
      for (const std::string& name : found) right = right && reader.read<double>(name) == written.at(name);
      reader.close();
      return right ? 0 : 2;
    } catch (const StoreError& error) {
      return error.kind == StoreError::Kind::damaged ? 1 : 2;
    }
  };
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); at += kPiece) {
    std::string damaged = whole;
    std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(at), std::min(kPiece, whole.size() - at), '\0');
    std::ofstream(file, std::ios::binary) << damaged;
    const pid_t child = ::fork();
    if (child == 0) ::_exit(in_child());
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) < 2) << "zeros from byte " << at << ": status " << status;
    refused += WIFEXITED(status) && WEXITSTATUS(status) == 1 ? 1 : 0;
  }
  EXPECT_GT(refused, 20);
}

TEST(Hdf5HandleDeathTest, LeftOpenWithoutAnErrorEndsTheProgram) {
  EXPECT_DEATH(
      {
        initialise();
        const Handle forgotten(H5Screate(H5S_SCALAR), H5Sclose, OnError::close, "make a space");
      },
      "was not closed");
}

TEST(Hdf5Handle, LeftOpenByAnErrorIsClosedOnlyWhereNothingWasWritten) {
  initialise();
  for (const OnError on_error : {OnError::close, OnError::abandon}) {
    const hid_t id = H5Screate(H5S_SCALAR);
    try {
      const Handle handle(id, H5Sclose, on_error, "make a space");
      throw std::runtime_error("on its way");
    } catch (const std::runtime_error&) {
    }
    EXPECT_EQ(H5Iis_valid(id) > 0, on_error == OnError::abandon);
  }
}

TEST(Hdf5Handle, ThatCannotBeClosedIsAnError) {
  initialise();
  const auto fail_to_close = [](hid_t) -> herr_t { return -1; };
  for (const OnError on_error : {OnError::close, OnError::abandon}) {
    Handle handle(H5Screate(H5S_SCALAR), fail_to_close, on_error, "make a space");
    EXPECT_THROW(handle.close(), StoreError);
  }
}

TEST(Hdf5Handle, SaysWhyItCannotBeOpened) {
  try {
    FileReader reader("/nowhere.h5");
    FAIL();
  } catch (const StoreError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot read /nowhere.h5"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos);
  }
}

}  // namespace
}  // namespace seapile::store::hdf5
