#include "reports/claims/readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

std::string entry(const std::string& id, const std::string& effect) {
  return "[[readings]]\nid = \"" + id +
         "\"\ntitle = \"t\"\npaper = \"p\"\nreading = \"r\"\nalternatives = \"a\"\neffect = \"" + effect +
         "\"\noption = \"\"\n";
}

std::string failure(const TemporaryFolder& folder, const std::string& text) {
  const std::filesystem::path path = folder.path() / "readings.toml";
  std::ofstream(path) << text;
  try {
    read_readings(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Readings, TheLedgerIsComplete) {
  const nlohmann::json readings = read_readings(std::string(HBR_SOURCE_DIR) + "/reports/readings.toml");
  EXPECT_GE(readings.size(), 30u);
  EXPECT_EQ(readings[0].size(), 7u);
}

TEST(Readings, AreReadStrictly) {
  TemporaryFolder folder;
  EXPECT_EQ(failure(folder, entry("a", "e") + entry("b", "e")), "no error");
  EXPECT_THAT(failure(folder, entry("a", "e") + entry("a", "e")), testing::HasSubstr("twice"));
  EXPECT_THAT(failure(folder, entry("a", "")), testing::HasSubstr("empty"));
  EXPECT_THAT(failure(folder, entry("a", "e") + "options = \"\"\n"), testing::HasSubstr("unknown key"));
  EXPECT_THAT(failure(folder, "[[readings]]\nid = \"a\"\n"), testing::HasSubstr("missing key"));
}

}  // namespace
}  // namespace hbr
