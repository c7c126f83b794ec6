#include "reports/kept/verdict_table.h"

#include <gmock/gmock.h>

#include "pipeline/artifact/content.h"
#include "pipeline/statistics/table.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

// Two claims that the mean of arcs is at least -2, the second not the paper's.
std::filesystem::path rules(const TemporaryFolder& folder) {
  std::string text = "sizes = [{ name = \"many\", needs = [{ of = \"layer3.n10.mean\", at_least = 50 }] }]\n";
  for (const char* by : {"result", "ours"})
    text +=
        std::string("[[claims]]\nid = \"") + by +
        "\"\nplace = \"5.4\"\nstatement = \"Arcs are good.\"\nquote = \"\"\npaper = \"\"\nsize = \"many\"\n"
        "decided_by = \"" +
        by +
        "\"\nchecks = [{ words = \"w\", kind = \"value\", of = \"layer3.n10.mean\", to = \"\", "
        "reproduced = [-2, 0], partly = [-4, 0], p_below = 1 }]\n";
  write_file(folder.path() / "claims.toml", text);
  return folder.path() / "claims.toml";
}

nlohmann::json arcs(double mean, int replications) {
  StatisticsTable table("test");
  for (int r = 0; r < replications; ++r) table.add("layer3.n10.mean", r, mean);
  return table.json();
}

TEST(VerdictTable, NamesTheReadingsThatMoveAClaim) {
  const TemporaryFolder folder;
  KeptRun run, study;
  run.statistics[""] = arcs(-3, 50);
  study.statistics = {
      {"", arcs(-1, 5)}, {"same", arcs(-1.5, 5)}, {"worse", arcs(-3, 5)}, {"bad", arcs(-9, 5)}};
  study.statistics["none"] = {{"quantities", nlohmann::json::object()},
                              {"numbers", nlohmann::json::object()}};
  const VerdictTable table{"t", "f", {"paper", "lines"}, {"study", "other"}};
  EXPECT_EQ(as_markdown(table, {{"paper", run}, {"study", study}}, rules(folder)),
            "| Claim | `paper` | `lines` | moved in `study` to | moved in `other` to |\n"
            "| --- | --- | --- | --- | --- |\n"
            "| Arcs are good. (5.4) | partly | – | `bad` not, `worse` partly | – |\n");
}

}  // namespace
}  // namespace hbr
