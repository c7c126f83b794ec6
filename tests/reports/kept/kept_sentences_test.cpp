#include "reports/kept/kept_sentences.h"

#include <gmock/gmock.h>

#include "pipeline/artifact/content.h"
#include "pipeline/core/check.h"
#include "tests/reports/kept/kept_runs.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* kRules = R"(
sizes = []
[[claims]]
id = "sizes"
place = "5"
statement = "About 1 500."
quote = ""
paper = "1 500"
size = ""
decided_by = "result"
checks = [{ words = "elites", kind = "value", of = "pooled.layer2_size", to = "", reproduced = [1000, 2000], partly = [0], p_below = 1 }]
)";

class KeptSentences : public testing::Test {
 protected:
  KeptSentences() { write_file(rules_, kRules); }

  std::string filled(const std::string& text, const std::string& sentence) const {
    return with_sentences(text, "F.md", {{"F.md", sentence}, {"G.md", "not in this file"}}, runs_, rules_);
  }

  TemporaryFolder folder_;
  std::filesystem::path rules_ = folder_.path() / "claims.toml";
  std::map<std::string, KeptRun> runs_{{"paper", kept()}};
};

TEST_F(KeptSentences, HaveTheKeptRunsFigures) {
  const std::string sentence =
      "There are {{paper number:pooled.layer2_size}} lines (paper: 1 397), {{paper value:memory}} at most.";
  EXPECT_EQ(filled("A. There are 7 lines (paper: 1 397), ? at most. B.", sentence),
            "A. There are 1\u202f400 lines (paper: 1 397), 0.20\u202fGB at most. B.");
  // Lines may break anywhere, and stay as they are broken; a new figure is in one piece.
  EXPECT_EQ(filled("There\nare 1 23\n4 lines\n  (paper: 1 397), 2 at\nmost.\n", sentence),
            "There\nare 1\u202f400 lines\n  (paper: 1 397), 0.20\u202fGB at\nmost.\n");
  EXPECT_EQ(filled("It is 4.5. B.", "is {{paper number:pooled.layer2_size}}."), "It is 1\u202f400. B.");
  runs_["paper"].statistics[""]["tests"]["accuracy.n1_vs_accuracy.n10"] = {
      {"p", 0.25}, {"n_a", 9}, {"n_b", 9}};
  EXPECT_EQ(filled("tell (p =\n0.25).", "tell ({{paper test:accuracy.n1_vs_accuracy.n10:p}})."),
            "tell (p =\n0.25).");
  const std::string right = filled("There are 7 lines (paper: 1 397), ? at most.", sentence);
  EXPECT_EQ(filled(right, sentence), right);
}

TEST_F(KeptSentences, MayQuoteVariationsAndWhatDecidesClaims) {
  runs_["paper"].statistics["other"] = runs_["paper"].statistics[""];
  runs_["paper"].statistics["other"]["numbers"]["pooled.layer2_size"]["value"] = 1500;
  EXPECT_EQ(filled("a ? b", "a {{paper/other number:pooled.layer2_size}} b"), "a 1\u202f500 b");
  EXPECT_EQ(filled("a ? b", "a {{paper claim:sizes:1:figure}} b"), "a 1\u202f400 b");
  EXPECT_EQ(filled("a ? b", "a {{paper/other claim:sizes:1:figure}} b"), "a 1\u202f500 b");
}

TEST_F(KeptSentences, MustStandThereOnceAndQuoteWhatIsKept) {
  const std::string good = "a {{paper number:pooled.layer2_size}} b";
  const auto refused = [&](const std::string& text, const std::string& sentence, const std::string& why) {
    EXPECT_THAT([&] { filled(text, sentence); },
                ThrowsMessage<InputError>(testing::AllOf(
                    testing::StartsWith("F.md: the sentence '" + sentence + "'"), HasSubstr(why))));
  };
  refused("a 1 c", good, "found it 0 times");
  refused("a 1 b a 2 b", good, "found it 2 times");
  refused("a " + std::string(41, '1') + " b", good, "found it 0 times");
  refused("a 1 b", "a {{lines number:pooled.layer2_size}} b", "the run 'lines' is not kept");
  refused("a 1 b", "a {{paper/x number:pooled.layer2_size}} b", "no variation 'x'");
  refused("a 1 b", "a {{paper stat:layer4.mean:median}} b", "did not measure 'stat:layer4.mean:median'");
  refused("a 1 b", "a {{paper stat:layer4.maen:median}} b", "which no profile measures");
  refused("a 1 b", "a {{paper claim:sizes:2:figure}} b", "no check 2 of a claim 'sizes'");
  refused("a 1 b", "a {{paper claim:sizes:1:p}} b", "did not measure 'claim:sizes:1:p'");
}

}  // namespace
}  // namespace hbr
