#include "pipeline/artifact/unit_columns.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "pipeline/core/check.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class UnitColumnsTest : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  TemporaryFolder folder_;
};

const UnitColumns kColumns{{"start x", "pen width", "é"}, {"m", "px", ""}, -1, 1, {-0.6, 1, 0}, {0.6, 4, 1}};

TEST_F(UnitColumnsTest, ComeBackAsTheyWereWritten) {
  {
    Hdf5Writer out(file("a.h5"));
    out.write("group/solution", {2, 3}, std::vector<float>(6).data());
    out.write("objective", std::vector<float>{1});
    write_unit_columns(out, "group/solution", kColumns);
    write_value_meaning(out, "objective", {"minus what it costs", "rad^2"});
    out.close();
  }
  const int locked = ::open(file("a.h5").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(locked, LOCK_EX), 0);  // which nobody heeds
  const UnitColumns columns = read_unit_columns(file("a.h5"), "group/solution");
  ::close(locked);
  EXPECT_EQ(columns.names, kColumns.names);
  EXPECT_EQ(columns.units, kColumns.units);
  EXPECT_EQ(columns.low, -1);
  EXPECT_EQ(columns.high, 1);
  EXPECT_THAT(columns.from, ElementsAre(-0.6, 1, 0));
  EXPECT_THAT(columns.to, ElementsAre(0.6, 4, 1));
  const ValueMeaning value = read_value_meaning(file("a.h5"), "objective");
  EXPECT_EQ(value.meaning, "minus what it costs");
  EXPECT_EQ(value.units, "rad^2");
}

TEST_F(UnitColumnsTest, SayWhatIsNotAsExpected) {
  Hdf5Writer out(file("a.h5"));
  const std::vector<float> values(3);
  for (const char* array : {"short", "turned", "bare", "words"}) out.write(array, values);
  UnitColumns other = kColumns;
  other.units.pop_back();
  write_unit_columns(out, "short", other);
  other = kColumns;
  other.high = -1;
  write_unit_columns(out, "turned", other);
  out.attribute("names", 0.5, "words");
  out.attribute("meaning", std::vector<std::string>{"one", "two"}, "words");
  out.close();
  const auto of = [&](const char* array) {
    return [path = file("a.h5"), array] { read_unit_columns(path, array); };
  };
  EXPECT_THAT(of("short"), ThrowsMessage<InputError>(HasSubstr("a.h5: short: units: expected 3 texts")));
  EXPECT_THAT(of("turned"), ThrowsMessage<InputError>(HasSubstr("turned: low, high: expected")));
  EXPECT_THAT(of("bare"), ThrowsMessage<InputError>(HasSubstr("bare: names: the array has no attribute")));
  EXPECT_THAT(of("words"),
              ThrowsMessage<InputError>(HasSubstr("words: names: expected an attribute with texts")));
  EXPECT_THAT(of("none"), ThrowsMessage<InputError>(HasSubstr("none: the file has no array of that name")));
  EXPECT_THAT([&] { read_value_meaning(file("a.h5"), "words"); },
              ThrowsMessage<InputError>(HasSubstr("meaning: expected an attribute with one value")));
}

}  // namespace
}  // namespace hbr
