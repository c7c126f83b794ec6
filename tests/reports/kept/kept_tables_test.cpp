#include "reports/kept/kept_tables.h"

#include <gmock/gmock.h>

#include "pipeline/artifact/content.h"
#include "pipeline/core/check.h"
#include "tests/reports/kept/kept_runs.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const KeptTable kTable = {"t",
                          "README.md",
                          {"What", "paper", "lines", "the paper says"},
                          {"paper", "lines"},
                          {{"lines", {}, {"{{stat:accuracy.n10:n}} of {{number:pooled.layer2_size}}"}, "1"},
                           {"not measured", {}, {"{{stat:layer4.mean:median}}"}, ""},
                           {"one run's", {"paper"}, {"{{value:cpu}}", "{{value:memory}}"}, ""},
                           {"stages'", {"paper"}, {"{{value:cpu.layer1}}", "{{value:each.layer1}}"}, ""},
                           {"verdicts", {}, {"{{value:verdicts}}"}, ""}}};

TEST(KeptTables, HoldTheKeptRunsFigures) {
  KeptRun old = kept();
  old.costs.clear();
  EXPECT_EQ(as_markdown(kTable, {{"paper", kept()}}),
            "| What | paper | lines | the paper says |\n"
            "| --- | --- | --- | --- |\n"
            "| lines | 50 of 1\u202f400 | – | 1 |\n"
            "| not measured | – | – |  |\n"
            "| one run's | 31\u202fs | 0.20\u202fGB |  |\n"
            "| stages' | 1.25\u202fs | 0.625\u202fs |  |\n"
            "| verdicts | 1 / 0 / 0 / 0 of 2 | – |  |\n");
  EXPECT_THAT(as_markdown(kTable, {{"paper", old}}), HasSubstr("| one run's | – | – |  |"));
}

TEST(KeptTables, RefuseWhatNoRunCanHave) {
  for (const char* wrong :
       {"{{stat:acuracy.n10}}", "{{value:cpus}}", "{{test:accuracy.n10:p}}", "{{stat}}"}) {
    KeptTable table = kTable;
    table.rows[0].cells = {wrong};
    EXPECT_THROW(as_markdown(table, {{"paper", kept()}}), InputError) << wrong;
  }
  KeptTable table = kTable;
  table.rows[0].cells.push_back("more");
  EXPECT_THAT([&] { as_markdown(table, {}); },
              ThrowsMessage<InputError>(
                  HasSubstr("expected 4 cells, as in its head, found 6 in the row of 'lines'")));
}

TEST(KeptTables, StandBetweenTheirMarks) {
  const std::string begin = "a\n<!-- table t: `make figures` fills it -->\n",
                    end = "<!-- end of table -->\nb\n";
  EXPECT_EQ(with_table(begin + "old\n" + end, "README.md", "t", "new\n"), begin + "new\n" + end);
  EXPECT_EQ(with_table(begin + end, "README.md", "t", "new\n"), begin + "new\n" + end);
  // Without an end of its own it would take another table's, and all that stands between.
  const std::string unended = begin + "<!-- table u: `make figures` fills it -->\n" + end;
  for (const std::string& text : {std::string(), begin, end, end + begin, unended})
    EXPECT_THAT(
        [&] { with_table(text, "README.md", "t", ""); },
        ThrowsMessage<InputError>(HasSubstr("README.md: expected a line '<!-- table t: `make figures`")));
}

TEST(KeptTables, AreReadStrictly) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.toml";
  const std::string good =
      "rules = 'r'\n[[tables]]\nname = 't'\nfile = 'f'\nhead = ['a', 'b']\nruns = []\nrows = [{what = 'w', "
      "runs = [], "
      "cells = [], last = 'l'}]\n"
      "[[verdicts]]\nname = 'v'\nfile = 'f'\nruns = []\nstudies = ['s']\n"
      "[[sentences]]\nfile = 'f'\ntext = 'a {{paper number:n}} b'\n";
  write_file(file, good);
  EXPECT_EQ(read_kept_tables(file).tables.at(0).rows.at(0).last, "l");
  EXPECT_EQ(read_kept_tables(file).verdicts.at(0).studies.at(0), "s");
  EXPECT_EQ(read_kept_tables(file).sentences.at(0).text, "a {{paper number:n}} b");
  for (const std::string& wrong :
       {good + "nam = 't'\n", good.substr(0, good.find("rows")), std::string("[[tables\n")}) {
    write_file(file, wrong);
    EXPECT_THAT([&] { read_kept_tables(file); },
                ThrowsMessage<InputError>(testing::StartsWith(file.string())));
  }
}

// Whoever keeps another run, or edits a figure by hand, is told to run `make figures`.
TEST(KeptTables, OfTheReadmesAreTheReferences) {
  const std::filesystem::path sources = HBR_SOURCE_DIR;
  const auto kept = read_all_kept(sources / "reports/reference");
  EXPECT_TRUE(kept.contains("reduced") && kept.contains("paper"));
  const KeptTables all = read_kept_tables(sources / "reports/kept_tables.toml");
  EXPECT_FALSE(all.tables.empty() || all.verdicts.empty() || all.sentences.empty());
  for (const auto& [file, text] : filled_files(all, kept, sources))
    EXPECT_EQ(text, read_whole(sources / file)) << file << ": `make figures` fills its figures";
}

}  // namespace
}  // namespace hbr
