#include "pipeline/artifact/profile.h"

#include <gmock/gmock.h>

#include <fstream>

#include "pipeline/core/check.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;

struct SmallPart {
  std::string name;
  int size = 0;
};
template <class Fields>
void describe(Fields& f, SmallPart& s) {
  f.text("name", s.name, "part");
  f.number("size", s.size, Range{1, 9}, "its size");
}

struct SmallSearch {
  int batch = 0;
  double spacing = 0;
};
template <class Fields>
void describe(Fields& f, SmallSearch& s) {
  f.number("batch", s.batch, Range{1, 100}, "children");
  f.number("spacing", s.spacing, Range{0, 1}, "distance");
}

struct Small {
  std::string name;
  SmallSearch search;
  std::vector<double> links;
  std::vector<SmallPart> parts;
};
template <class Fields>
void describe(Fields& f, Small& s) {
  f.text("name", s.name, "name");
  f.table("search", s.search, "search");
  f.numbers("links", s.links, Range{0, 9}, "links");
  f.tables("parts", s.parts, "parts");
}

class Inheritance : public testing::Test {
 protected:
  Inheritance() {
    std::filesystem::create_directories(folder_.path() / "below");
    write("base.toml",
          "name = \"base\"\nlinks = [1, 2, 3]\n[search]\nbatch = 10\nspacing = 0.5\n"
          "[[parts]]\nname = \"a\"\nsize = 1\n[[parts]]\nname = \"b\"\nsize = 2\n");
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path() / name) << text;
  }
  Small read(const std::string& name) {
    return settings_from_source<Small>(read_inheriting(folder_.path() / name));
  }
  // Without the folder's name.
  std::string complaint(const std::string& name) {
    try {
      read(name);
    } catch (const InputError& error) {
      std::string text = error.what();
      for (const std::string& place = folder_.path().string() + "/"; text.find(place) != std::string::npos;)
        text.erase(text.find(place), place.size());
      return text;
    }
    return "no complaint";
  }
  TemporaryFolder folder_;
};

TEST_F(Inheritance, TablesMergeAndEverythingElseIsReplaced) {
  write("below/heir.toml",
        "base = \"../base.toml\"\nname = \"heir\"\nlinks = [4]\n[search]\nspacing = 0.25\n");
  const Small heir = read("below/heir.toml");
  EXPECT_EQ(heir.name, "heir");
  EXPECT_EQ(heir.links, std::vector<double>{4});
  EXPECT_EQ(heir.search.batch, 10);
  EXPECT_EQ(heir.search.spacing, 0.25);
  ASSERT_EQ(heir.parts.size(), 2u);
  EXPECT_EQ(heir.parts[1].size, 2);

  write("heir.toml", "base = \"below/heir.toml\"\nname = \"next\"\n[[parts]]\nname = \"b\"\nsize = 7\n");
  const Small next = read("heir.toml");
  EXPECT_EQ(next.links, std::vector<double>{4});
  EXPECT_EQ(next.search.spacing, 0.25);
  ASSERT_EQ(next.parts.size(), 1u);
  EXPECT_EQ(next.parts[0].size, 7);
}

// The same settings written out in one file are the same settings.
TEST_F(Inheritance, IsTheSameAsWritingItOut) {
  write("heir.toml", "base = \"base.toml\"\nname = \"x\"\nlinks = []\nsearch.batch = 3\n");
  write("whole.toml",
        "name = \"x\"\nlinks = []\n[search]\nbatch = 3\nspacing = 0.5\n"
        "[[parts]]\nname = \"a\"\nsize = 1\n[[parts]]\nname = \"b\"\nsize = 2\n");
  EXPECT_EQ(read_inheriting(folder_.path() / "heir.toml").values,
            read_inheriting(folder_.path() / "whole.toml").values);
  EXPECT_EQ(settings_to_json(read("heir.toml")), settings_to_json(read("whole.toml")));
}

TEST_F(Inheritance, ErrorsStandWhereTheValueDoes) {
  write("heir.toml", "base = \"base.toml\"\nname = \"heir\"\n[search]\nspacing = 2\n");
  EXPECT_THAT(complaint("heir.toml"), HasSubstr("heir.toml:4:11: search.spacing: expected"));
  write("heir.toml", "base = \"base.toml\"\nname = \"heir\"\n[search]\nspacng = 2\n");
  EXPECT_EQ(complaint("heir.toml"), "heir.toml:4:1: unknown key 'search.spacng' (did you mean 'spacing'?)");
  write("heir.toml", "base = \"base.toml\"\nname = \"heir\"\nsearch = 3\n");
  EXPECT_THAT(complaint("heir.toml"), HasSubstr("heir.toml:3:10: search: expected a table"));
  write("heir.toml", "base = \"base.toml\"\nname = \"heir\"\n[[parts]]\nname = \"a\"\n");
  EXPECT_EQ(complaint("heir.toml"), "heir.toml:3:1: missing key 'parts.0.size' (its size)");
  write("heir.toml", "base = \"base.toml\"\n");
  EXPECT_EQ(complaint("heir.toml"), "heir.toml:1:1: missing key 'name' (name)");

  write("wrong.toml", "name = \"wrong\"\nlinks = [1, 20]\n[search]\nbatch = 10\nspacing = 0.5\n");
  write("heir.toml", "base = \"wrong.toml\"\nname = \"heir\"\nparts = []\n");
  EXPECT_THAT(complaint("heir.toml"), HasSubstr("wrong.toml:2:13: links.1: expected"));
}

TEST_F(Inheritance, ABaseThatCannotBeIsTold) {
  write("heir.toml", "name = \"heir\"\nbase = \"bse.toml\"\n");
  EXPECT_EQ(complaint("heir.toml"),
            "heir.toml:2:8: base: there is no file 'bse.toml'; expected a path relative to the folder of "
            "heir.toml");
  write("heir.toml", "base = 3\n");
  EXPECT_EQ(complaint("heir.toml"),
            "heir.toml:1:8: base: expected a file's name (the profile that this one changes), found 3");
  write("heir.toml", "base = \"below/other.toml\"\nname = \"heir\"\n");
  write("below/other.toml", "name = \"other\"\nbase = \"../heir.toml\"\n");
  EXPECT_EQ(complaint("heir.toml"),
            "below/other.toml:2:8: base: 'heir.toml' leads back to itself; expected a profile that does not "
            "build on this one");
  write("heir.toml", "base = \"heir.toml\"\nname = \"heir\"\n");
  EXPECT_THAT(complaint("heir.toml"), HasSubstr("leads back to itself"));
}

TEST_F(Inheritance, APartKeepsItsPlaces) {
  const SettingsSource source = read_inheriting(folder_.path() / "base.toml");
  const SettingsSource part = part_of(source, "/parts/1");
  EXPECT_EQ(part.values, (nlohmann::json{{"name", "b"}, {"size", 2}}));
  EXPECT_EQ(part.places.at("/size").line, 11u);
  EXPECT_EQ(part.keys.at("/name").line, 10u);
  EXPECT_FALSE(part.places.contains("/parts/0"));
}

// A key's parts lie one within the other: so many would end the stack.
TEST_F(Inheritance, AKeyOfManyPartsIsRefused) {
  std::string deep = "a";
  for (int i = 0; i < 200'000; ++i) deep += ".a";
  for (const std::string& line : {deep + " = 1", "[" + deep + "]", "[[" + deep + "]]"}) {
    write("deep.toml", "name = \"x\"\n" + line + "\n");
    EXPECT_THAT([&] { read_toml(folder_.path() / "deep.toml"); },
                testing::ThrowsMessage<InputError>(HasSubstr("deep.toml:2:1: a key of more than 32 parts")));
  }
  write("dots.toml", "# " + deep + "\nname = \"" + deep + "\"\n");
  EXPECT_NO_THROW(read_toml(folder_.path() / "dots.toml"));
}

}  // namespace
}  // namespace hbr
