// `make keys`: nothing that a profile says is missing from the list of what may be said.
#include "stages/plan/profile_keys.h"

#include <gmock/gmock.h>

#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers.h"
#include "tests/stages/planned.h"

namespace hbr {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// The lines of values in a table and those within it; lists of tables by their first.
void expect_told(const std::string& text, const json& values, const std::string& prefix, const json& whole) {
  for (const auto& [key, value] : values.items()) {
    if (value.is_object()) {
      expect_told(text, value, prefix + key + ".", whole);
    } else if (value.is_array() && !value.empty() && value[0].is_object()) {
      expect_told(text, value[0], prefix + key + "[].", whole);
    } else {
      const bool listed = prefix.find("[]") != std::string::npos;
      EXPECT_THAT(text, HasSubstr("\n" + prefix + key + " = " + (listed ? "..." : value.dump()) + "\n    "));
    }
  }
}

TEST(ProfileKeys, AreAllThatThePaperSays) {
  const SettingsSource paper = read_inheriting(kProfiles / "paper.toml");
  const std::string text = "\n" + profile_keys(paper);
  json plain = paper.values;
  for (const char* elsewhere : {"defaults", "layers", "variations", "readings"}) plain.erase(elsewhere);
  expect_told(text, plain, "", plain);
  for (const LayerKind& kind : layer_kinds())
    EXPECT_THAT(text,
                HasSubstr("\n[layers.NAME] with kind = \"" + std::string(kind.name) + "\": " + kind.meaning));
  for (const auto& [key, value] : paper.values["defaults"].items())
    if (!value.is_object()) {
      EXPECT_THAT(text, HasSubstr("\n" + key + " = " + value.dump() + "\n    ")) << key;
    }
  for (const auto& [key, value] : paper.values["defaults"]["pencil"].items())
    EXPECT_THAT(text, HasSubstr("\npencil." + key + " = " + value.dump() + "\n    ")) << key;
  for (const auto& [name, own] : paper.values["layers"].items())
    for (const auto& [key, value] : own.items())
      EXPECT_THAT(text, HasSubstr("\nlayers." + name + "." + key + " = " + value.dump() + "\n"));
  EXPECT_THAT(text, HasSubstr("\nlayers.layer2_n10.samples = 10\n"));
  EXPECT_THAT(text, HasSubstr("\nautoencoder.output = \"sigmoid\"\n    sigmoid | linear: "));
  EXPECT_THAT(text, HasSubstr("\nautoencoder.epochs = 200\n    whole, 1 to "));
  // What a kind's own defaults say comes before what all have.
  const std::size_t digits = text.find("with kind = \"digits\"");
  EXPECT_THAT(text.substr(digits), HasSubstr("\nout_of_range = \"radius\"\n    radius | axes | reject: "));
}

TEST(ProfileKeys, OfWhatIsNoTableAreRefused) {
  for (const char* key : {"defaults", "layers"}) {
    SettingsSource profile = read_inheriting(kProfiles / "paper.toml");
    profile.values[key] = 3;
    EXPECT_THAT([&] { profile_keys(profile); },
                testing::ThrowsMessage<InputError>(testing::AllOf(
                    HasSubstr("paper.toml: "), HasSubstr(std::string(key) + ": expected a table, found 3"))));
  }
}

}  // namespace
}  // namespace hbr
