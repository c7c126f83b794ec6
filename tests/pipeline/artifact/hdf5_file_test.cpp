#include "pipeline/artifact/hdf5_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class Hdf5File : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("hdf5_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const char* name) const { return folder_ / name; }
  static std::string bytes(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  template <class Body>
  static std::string complaint(Body body) {
    try {
      body();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }
  fs::path folder_;
};

template <class T>
Array<T> counted(std::vector<std::size_t> shape) {
  std::size_t n = 1;
  for (const std::size_t d : shape) n *= d;
  Array<T> array{std::move(shape), std::vector<T>(n)};
  std::iota(array.values.begin(), array.values.end(), T{});
  return array;
}

void write_example(const fs::path& path, std::size_t rows) {
  Hdf5Writer out(path);
  out.write("bytes", counted<std::uint8_t>({3, 5, 2}));
  out.write("group/inner/floats", counted<float>({rows, 8}));
  out.write("group/doubles", counted<double>({rows}));
  out.write("int32", counted<std::int32_t>({7}));
  out.write("int64", std::vector<std::int64_t>{std::numeric_limits<std::int64_t>::min(), -1,
                                               std::numeric_limits<std::int64_t>::max()});
  out.write("empty", counted<float>({0, 4}));
  out.attribute("settings", std::string(200'000, 'x') + "é");
  out.attribute("none", std::string());
  out.attribute("spacing", 0.1);
  out.attribute("seed", std::int64_t{9007199254740993});
  out.close();
}

TEST_F(Hdf5File, RoundTripsEveryTypeAndShape) {
  // Sizes below, at and above several chunks, so that no row is lost between them.
  for (const std::size_t rows : {1u, 100u, 32'768u, 32'769u, 100'003u}) {
    write_example(file("a.h5"), rows);
    const Hdf5Reader in(file("a.h5"));
    const auto floats = in.read<float>("group/inner/floats");
    EXPECT_THAT(floats.shape, ElementsAre(rows, 8));
    EXPECT_EQ(floats.values, counted<float>({rows, 8}).values);
    EXPECT_EQ(in.read<double>("group/doubles").values, counted<double>({rows}).values);
    EXPECT_THAT(in.read<std::uint8_t>("bytes").shape, ElementsAre(3, 5, 2));
    EXPECT_EQ(in.read<std::int32_t>("int32").values, counted<std::int32_t>({7}).values);
    EXPECT_THAT(
        in.read<std::int64_t>("int64").values,
        ElementsAre(std::numeric_limits<std::int64_t>::min(), -1, std::numeric_limits<std::int64_t>::max()));
    EXPECT_THAT(in.read<float>("empty").shape, ElementsAre(0, 4));
    EXPECT_EQ(in.text_attribute("settings"), std::string(200'000, 'x') + "é");
    EXPECT_EQ(in.text_attribute("none"), "");
    EXPECT_EQ(in.number_attribute("spacing"), 0.1);
    EXPECT_EQ(in.number_attribute("seed"), 9007199254740992.0);
    EXPECT_TRUE(in.has_attribute("spacing"));
    EXPECT_FALSE(in.has_attribute("spacings"));
    EXPECT_TRUE(in.has("group/inner"));
    EXPECT_FALSE(in.has("group/outer/floats"));
    EXPECT_THAT(in.children("group"), ElementsAre("doubles", "inner"));
    EXPECT_THAT(in.children("/"), ElementsAre("bytes", "empty", "group", "int32", "int64"));
  }
}

TEST_F(Hdf5File, EqualContentsAreEqualBytes) {
  write_example(file("a.h5"), 40'000);
  ::sleep(1);  // a time stamp would show
  // Memory that was used before: what HDF5 pads chunks with must not be what was left there.
  { const std::vector<std::uint8_t> dirt(std::size_t{64} << 20, 0xA5); }
  write_example(file("b.h5"), 40'000);
  EXPECT_TRUE(bytes(file("a.h5")) == bytes(file("b.h5")));
}

TEST_F(Hdf5File, SaysWhatIsNotAsExpected) {
  write_example(file("a.h5"), 10);
  const Hdf5Reader in(file("a.h5"));
  EXPECT_EQ(complaint([&] { in.read<float>("missing"); }),
            file("a.h5").string() + ": missing: the file has no array of that name");
  EXPECT_THAT(complaint([&] { in.read<float>("group"); }), HasSubstr("expected an array"));
  EXPECT_THAT(complaint([&] { in.read<float>("group/doubles"); }),
              HasSubstr("expected elements of type float32, found float of 64 bits"));
  EXPECT_THAT(complaint([&] { in.children("bytes"); }), HasSubstr("expected a group"));
  EXPECT_THAT(complaint([&] { in.text_attribute("spacing"); }), HasSubstr("with a text"));
  EXPECT_THAT(complaint([&] { in.number_attribute("settings"); }), HasSubstr("with a number"));
  EXPECT_THAT(complaint([&] { in.number_attribute("spacings"); }), HasSubstr("no attribute"));
  EXPECT_THAT(complaint([&] { Hdf5Reader(file("no.h5")); }), HasSubstr("No such file"));
  std::ofstream(file("text.h5")) << "not a repertoire\n";
  EXPECT_THAT(complaint([&] { Hdf5Reader(file("text.h5")); }), HasSubstr("not an HDF5 file"));
  EXPECT_THAT(complaint([&] { Hdf5Writer(folder_ / "no" / "a.h5"); }), HasSubstr("No such file"));
}

// As where a file system has no locks.
TEST_F(Hdf5File, IsReadWithoutALock) {
  write_example(file("a.h5"), 10);
  const int locked = ::open(file("a.h5").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(locked, LOCK_EX), 0);
  EXPECT_EQ(Hdf5Reader(file("a.h5")).number_attribute("spacing"), 0.1);
  ::close(locked);
}

// Nothing is stored of it that its shape could be compared with, and a reader may make room for its columns.
TEST_F(Hdf5File, AnEmptyArrayIsNoWiderThanAnyReaderNeeds) {
  const std::uint8_t none = 0;
  {
    Hdf5Writer out(file("a.h5"));
    out.write("rows", {0, 1 << 16}, &none);
    out.write("columns", {1 << 10, 0, 1 << 6}, &none);
    out.write("wide", {0, (1 << 16) + 1}, &none);
    out.write("long", {std::size_t{1} << 40, 0}, &none);
    out.write("both", {1 << 10, 0, (1 << 6) + 1}, &none);
    out.close();
  }
  const Hdf5Reader in(file("a.h5"));
  EXPECT_THAT(in.read<std::uint8_t>("rows").shape, ElementsAre(0, 1 << 16));
  EXPECT_THAT(in.read<std::uint8_t>("columns").shape, ElementsAre(1 << 10, 0, 1 << 6));
  for (const char* name : {"wide", "long", "both"})
    EXPECT_THAT(complaint([&] { in.read<std::uint8_t>(name); }),
                HasSubstr("without elements may, 65536 in all"))
        << name;
}

// Flips every bit of a small file in turn: each file is either refused or reads as it was.
TEST_F(Hdf5File, NoFlippedBitChangesWhatIsRead) {
  {
    Hdf5Writer out(file("a.h5"));
    out.write("measures", counted<float>({9, 2}));
    out.close();
  }
  const std::string good = bytes(file("a.h5"));
  std::fstream flipped(file("a.h5"), std::ios::in | std::ios::out | std::ios::binary);
  const auto flip = [&](std::size_t bit) {
    flipped.seekg(static_cast<std::streamoff>(bit / 8));
    const int byte = flipped.get();
    flipped.seekp(static_cast<std::streamoff>(bit / 8));
    flipped.put(static_cast<char>(byte ^ (1 << bit % 8))).flush();
  };
  int refused = 0;
  for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
    flip(bit);
    try {
      const auto read = Hdf5Reader(file("a.h5")).read<float>("measures");
      EXPECT_THAT(read.shape, ElementsAre(9, 2)) << bit;
      EXPECT_EQ(read.values, counted<float>({9, 2}).values) << bit;
    } catch (const InputError&) {
      ++refused;
    }
    flip(bit);
  }
  EXPECT_GT(refused, 72 * 8);  // at least every bit of the values
}

TEST_F(Hdf5File, RefusesFilesCutShort) {
  write_example(file("a.h5"), 1000);
  const std::string good = bytes(file("a.h5"));
  for (std::size_t size = 0; size < good.size(); size += 997) {
    std::ofstream(file("b.h5"), std::ios::binary) << good.substr(0, size);
    EXPECT_THROW(Hdf5Reader(file("b.h5")).read<float>("group/inner/floats"), InputError) << size;
  }
}

TEST_F(Hdf5File, AFullDiskIsOneClearLine) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 10'000;
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string limited = complaint([&] { write_example(file("a.h5"), 1000); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(limited,
            file("a.h5").string() +
                ": can't write: File too large; a limit on the size of files is set (ulimit -f): raise it");
  if (fs::exists("/dev/full")) {
    EXPECT_EQ(complaint([&] { write_example("/dev/full", 1000); }),
              "/dev/full: can't write: No space left on device; make room, or use a place on another disk");
  }
}

}  // namespace
}  // namespace hbr
