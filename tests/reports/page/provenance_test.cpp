#include "reports/page/provenance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "pipeline/artifact/manifest.h"
#include "pipeline/core/check.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

void manifest(const fs::path& out, const Node& node, double seconds) {
  Manifest m;
  m.made_from.slice = slice_of(node);
  for (const auto& [name, output] : node.inputs) m.made_from.inputs[name] = "its hash";
  m.key = m.made_from.key();
  m.run = {{"seconds", seconds},    {"cpu_seconds", 2 * seconds}, {"peak_memory_bytes", 5e6},
           {"version", "v1-dirty"}, {"compiler", "GCC 12"},       {"host", "<box>"}};
  fs::create_directories(manifest_path(out, node).parent_path());
  write_manifest(manifest_path(out, node), m);
}

TEST(Provenance, FillsThePageThatTheStageLeft) {
  const TemporaryFolder folder;
  const fs::path out = folder.path();
  for (int r = 0; r < 2; ++r)
    manifest(out,
             {"layer1", "layer1", r, fmt::format("layer1/{:02}.h5", r), nlohmann::json::object(), {}, {}},
             30);
  manifest(out,
           {"layer2",
            "layer2_n10",
            0,
            "layer2_n10/00.h5",
            nlohmann::json::object(),
            {{"layer1", "layer1/00.h5"}},
            {}},
           5);
  manifest(out,
           {"layer2",
            "layer2_n10",
            0,
            "short/layer2_n10/00.h5",
            nlohmann::json::object(),
            {{"layer1", "layer1/00.h5"}},
            {},
            "short"},
           7);
  manifest(out,
           {"report",
            "report",
            -1,
            "page",
            nlohmann::json::object(),
            {{"a", "layer1/01.h5"}, {"b", "layer2_n10/00.h5"}, {"c", "short/layer2_n10/00.h5"}},
            {}},
           1);
  fs::create_directories(out / "page/figures");
  std::ofstream(out / "page/index.html") << "a<!-- provenance -->b";
  std::ofstream(out / "page/figures/x.csv") << "1";
  publish_report(out / "page", out, out / "report");
  // Again, there is nothing to write; what somebody changed is put right.
  const std::string sign = fingerprint(out / "report");
  publish_report(out / "page", out, out / "report");
  EXPECT_EQ(fingerprint(out / "report"), sign);
  write_file(out / "report/more.txt", "x");
  publish_report(out / "page", out, out / "report");
  EXPECT_FALSE(fs::exists(out / "report/more.txt"));
  std::ifstream file(out / "report/index.html");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\"><code>layer1</code></th><td>2</td><td>1:00"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\"><code>layer2_n10</code></th><td>1</td><td>5.0 s"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\"><code>variation short</code></th><td>1</td><td>7.0 s"));
  EXPECT_THAT(page, HasSubstr("v1-dirty"));
  EXPECT_THAT(page, HasSubstr("&lt;box&gt;"));
  EXPECT_THAT(page, HasSubstr(">layer2_n10</text>"));
  EXPECT_TRUE(fs::exists(out / "report/figures/x.csv"));
  // What a user keeps beside it stays, and nothing else does.
  fs::create_directories(out / "report.old");
  write_file(out / "report.old/mine.txt", "x");
  write_file(out / "report/more.txt", "x");
  publish_report(out / "page", out, out / "report");
  EXPECT_TRUE(fs::exists(out / "report.old/mine.txt"));
  for (const auto& entry : fs::directory_iterator(out))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".tmp")) << entry.path();
}

// A finished run that can only be read, by a user whose Graphviz draws otherwise.
TEST(Provenance, LeavesAReportThatCanNotBeWritten) {
  const TemporaryFolder folder;
  const fs::path out = folder.path(), index = out / "report/index.html";
  manifest(out, {"report", "report", -1, "page", nlohmann::json::object(), {}, {}}, 1);
  fs::create_directories(out / "page");
  write_file(out / "page/index.html", "a<!-- provenance -->b");
  publish_report(out / "page", out, out / "report");
  // As another user, whom the folder lets in.
  const auto publish = [&] {
    if (::setuid(65534) != 0 && ::geteuid() == 0) std::exit(1);
    try {
      publish_report(out / "page", out, out / "report");
    } catch (const std::exception& error) {
      std::fprintf(stderr, "refused: %s\n", error.what());
      std::exit(2);
    }
    std::exit(0);
  };
  const auto only_read = [&](bool only) { fs::permissions(out, only ? fs::perms(0555) : fs::perms(0755)); };
  write_file(index, "a<svg of another Graphviz>b");
  only_read(true);
  EXPECT_EXIT(publish(), testing::ExitedWithCode(0), "report stays as it is: its folder can.t be written");
  EXPECT_EQ(read_whole(index), "a<svg of another Graphviz>b");
  // What is not this page is no report of it.
  only_read(false);
  write_file(index, "another page");
  only_read(true);
  EXPECT_EXIT(publish(), testing::ExitedWithCode(2), "refused: ");
  only_read(false);
}

TEST(Provenance, RefusesAPageWithoutAPlace) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { publish_report(folder.path() / "page", folder.path(), folder.path() / "report"); },
              ThrowsMessage<InputError>(HasSubstr("index.html: can't read: No such file")));
  fs::create_directories(folder.path() / "page");
  write_file(folder.path() / "page/index.html", "a page");
  EXPECT_THAT([&] { publish_report(folder.path() / "page", folder.path(), folder.path() / "report"); },
              ThrowsMessage<InputError>(HasSubstr("index.html has no place for the provenance")));
}

}  // namespace
}  // namespace hbr
