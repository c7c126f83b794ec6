#include "pipeline/core/settings.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::HasSubstr;

struct Search {
  int generations = 0;
  double spacing = 0;
  std::string selector;
  bool operator==(const Search&) const = default;
};
template <class Fields>
void describe(Fields& f, Search& s) {
  f.number("generations", s.generations, Range{1, 1e9}, "generations of the search");
  f.number("spacing", s.spacing, Range{1e-6, 1}, "least distance between elites");
  f.choice("selector", s.selector, {"curiosity", "uniform"}, "how parents are drawn");
}

struct Everything {
  std::uint64_t seed = 0;
  std::int64_t offset = 0;
  bool strict = false;
  std::string title;
  std::vector<double> spacings;
  std::vector<int> samples;
  std::vector<std::string> names;
  Search search;
  std::vector<Search> variants;
  bool operator==(const Everything&) const = default;
};
template <class Fields>
void describe(Fields& f, Everything& s) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  f.number("seed", s.seed, Range{0, infinity}, "the master seed");
  f.number("offset", s.offset, Range{-10, 10}, "an offset");
  f.flag("strict", s.strict, "a flag");
  f.text("title", s.title, "a title");
  f.numbers("spacings", s.spacings, Range{0, 1}, "spacings");
  f.numbers("samples", s.samples, Range{1, 100}, "samples");
  f.texts("names", s.names, "names");
  f.table("search", s.search, "the search");
  f.tables("variants", s.variants, "its variants");
}

constexpr const char* kProfile = R"(seed = 9007199254740993
offset = -3
strict = true
title = "a \"quoted\" título"
spacings = [0.1, 1, 0.30000000000000004]
samples = [1, 10]
names = ["x", "y"]

[search]
generations = 100
spacing = 0.01
selector = "uniform"

[[variants]]
generations = 1
spacing = 1
selector = "curiosity"

[[variants]]
generations = 2
spacing = 0.5
selector = "uniform"
)";

class Settings : public testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::path(testing::TempDir()) /
            (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".toml");
  }
  void TearDown() override { std::filesystem::remove_all(file_); }
  void write(const std::string& text) { std::ofstream(file_) << text; }
  // The message about the profile with `from` replaced by `to`, without the file's name.
  std::string complaint(const std::string& from, const std::string& to) {
    std::string text = kProfile;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    write(text.replace(at, from.size(), to));
    return complaint_of_file();
  }
  std::string complaint_of_file() {
    try {
      read_profile<Everything>(file_);
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      EXPECT_EQ(text.rfind(file_.string(), 0), 0u) << text;
      return text.substr(file_.string().size());
    }
    return "no complaint";
  }
  std::filesystem::path file_;
};

TEST_F(Settings, ReadsEveryKindOfField) {
  write(kProfile);
  const auto s = read_profile<Everything>(file_);
  EXPECT_EQ(s.seed, 9007199254740993u);  // not a double
  EXPECT_EQ(s.offset, -3);
  EXPECT_TRUE(s.strict);
  EXPECT_EQ(s.title, "a \"quoted\" título");
  EXPECT_EQ(s.spacings, (std::vector<double>{0.1, 1, 0.30000000000000004}));
  EXPECT_EQ(s.samples, (std::vector<int>{1, 10}));
  EXPECT_EQ(s.names, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(s.search, (Search{100, 0.01, "uniform"}));
  EXPECT_EQ(s.variants, (std::vector<Search>{{1, 1.0, "curiosity"}, {2, 0.5, "uniform"}}));
}

TEST_F(Settings, JsonRoundTripIsExactAndCanonical) {
  write(kProfile);
  const auto s = read_profile<Everything>(file_);
  const std::string text = settings_to_json(s).dump();
  EXPECT_EQ(settings_from_json<Everything>(nlohmann::json::parse(text), "slice"), s);
  EXPECT_EQ(settings_to_json(settings_from_json<Everything>(nlohmann::json::parse(text), "slice")).dump(),
            text);
  EXPECT_EQ(settings_to_json(Search{3, 1, "uniform"}).dump(),
            R"({"generations":3,"selector":"uniform","spacing":1.0})");
}

struct MayHaveVariants {
  std::string title;
  std::vector<Search> variants;
};
template <class Fields>
void describe(Fields& f, MayHaveVariants& s) {
  f.text("title", s.title, "a title");
  f.optional_tables("variants", s.variants, "its variants, if any");
}

// What is left out reads as none and is not written, so that who never heard of it sees no difference.
TEST_F(Settings, TablesMayBeLeftOut) {
  write("title = \"x\"\n");
  auto s = read_profile<MayHaveVariants>(file_);
  EXPECT_TRUE(s.variants.empty());
  EXPECT_EQ(settings_to_json(s).dump(), R"({"title":"x"})");
  s.variants = {{1, 1.0, "curiosity"}};
  EXPECT_EQ(settings_from_json<MayHaveVariants>(settings_to_json(s), "slice").variants, s.variants);
  write("title = \"x\"\n[[variants]]\ngenerations = 1\n");
  EXPECT_THAT([&] { read_profile<MayHaveVariants>(file_); },
              testing::ThrowsMessage<InputError>(HasSubstr("missing key 'variants.0.spacing'")));
}

TEST_F(Settings, ErrorsSayWhereWhatAndHow) {
  EXPECT_EQ(complaint("generations = 100", "generation = 100"),
            ":10:1: unknown key 'search.generation' (did you mean 'generations'?)");
  EXPECT_EQ(complaint("generations = 100\n", ""),
            ":9:1: missing key 'search.generations' (generations of the search)");
  EXPECT_EQ(complaint("offset = -3\n", ""), ":1:1: missing key 'offset' (an offset)");
  EXPECT_THAT(complaint("[search]\ngenerations = 100\nspacing = 0.01\n", "[search]\n"),
              HasSubstr("missing key 'search.generations' (generations of the search), and of the same table "
                        "'spacing' ("));
  EXPECT_EQ(
      complaint("generations = 100", "generations = 0.5"),
      ":10:15: search.generations: expected a whole number from 1 to 1000000000 (generations of the search), "
      "found 0.5");
  EXPECT_EQ(
      complaint("generations = 100", "generations = 0"),
      ":10:15: search.generations: expected a whole number from 1 to 1000000000 (generations of the search), "
      "found 0");
  EXPECT_EQ(complaint("spacing = 0.01", "spacing = \"wide\""),
            ":11:11: search.spacing: expected a number from 1e-06 to 1 (least distance between elites), "
            "found \"wide\"");
  EXPECT_THAT(complaint("spacing = 0.01", "spacing = nan"), HasSubstr("found nan"));
  EXPECT_THAT(complaint("spacing = 0.01", "spacing = inf"), HasSubstr("found inf"));
  EXPECT_EQ(
      complaint("selector = \"uniform\"", "selector = \"unifrom\""),
      ":12:12: search.selector: expected one of \"curiosity\", \"uniform\" (how parents are drawn), found "
      "\"unifrom\" (did you mean 'uniform'?)");
  EXPECT_EQ(complaint("strict = true", "strict = 1"),
            ":3:10: strict: expected true or false (a flag), found 1");
  EXPECT_EQ(complaint("strict = true", "strict = 1979-05-27"),
            ":3:10: strict: expected true or false (a flag), found nothing, a date or a time");
  EXPECT_THAT(complaint("seed = 9007199254740993", "seed = -1"),
              HasSubstr(":1:8: seed: expected a whole number"));
  EXPECT_THAT(complaint("[1, 10]", "[1, 101]"),
              HasSubstr(":6:15: samples.1: expected a whole number from 1 to 100"));
  EXPECT_THAT(complaint("[1, 10]", "3"), HasSubstr("samples: expected a list (samples), found 3"));
  EXPECT_THAT(complaint("[\"x\", \"y\"]", "[\"x\", 1]"),
              HasSubstr("names.1: expected a text (names), found 1"));
  EXPECT_THAT(complaint("[search]\n", "search = 3\n[extra]\n"),
              HasSubstr(":9:10: search: expected a table (the search), found 3"));
  EXPECT_THAT(complaint("generations = 2", "generations = true"),
              HasSubstr(":20:15: variants.1.generations: expected"));
}

TEST_F(Settings, RefusesDuplicatesAndBrokenFiles) {
  EXPECT_THAT(complaint("offset = -3", "offset = -3\noffset = 4"), HasSubstr(":3:"));
  EXPECT_THAT(complaint("offset = -3", "offset = -3\noffset = 4"), HasSubstr("duplicate key"));
  EXPECT_THAT(complaint("[search]", "[search"), HasSubstr(":9:8: "));
  EXPECT_THAT(complaint("seed = 9007199254740993", "seed = 9223372036854775808"), HasSubstr(":1:"));
  std::filesystem::remove(file_);
  EXPECT_THAT(complaint_of_file(), HasSubstr("No such file"));
  std::filesystem::create_directory(file_);
  EXPECT_THAT(complaint_of_file(), HasSubstr("it is a folder"));
}

TEST(DidYouMean, OffersOnlyNearWords) {
  EXPECT_EQ(did_you_mean("lyer3", {"layer1", "layer3"}), " (did you mean 'layer3'?)");
  EXPECT_EQ(did_you_mean("report", {"layer1", "layer3"}), "");
  EXPECT_EQ(did_you_mean("x", {}), "");
}

}  // namespace
}  // namespace hbr
