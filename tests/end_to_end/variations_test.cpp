// A profile that inherits and varies, through the tool and a real make.
#include <gmock/gmock.h>

#include "tests/end_to_end/tiny_experiment.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Variations, RunOnlyWhatTheyTouchAndGiveTheBytesOfTheChangedProfile) {
  TinyExperiment experiment;
  experiment.profile.set("replications", "lines", "2");
  experiment.profile.set("replications", "digits", "0");
  experiment.profile.set("dataset", "folder", "\"/no/such/folder\"");  // without digits nobody asks
  const std::string variation =
      "base = \"profile.toml\"\nname = \"varied\"\n[[variations]]\nname = \"short\"\nchanges = \"Shorter.\"\n"
      "set.defaults.arcs.epsilon = 0.2\nset.defaults.flat_arcs.epsilon = 0.2\n";
  std::ofstream(experiment.out("varied.toml")) << variation;
  const ShellResult plain = experiment.make("plain", 1);
  ASSERT_EQ(plain.code, 0) << plain.text;
  const ShellResult varied = experiment.make_of("varied.toml", "varied", 2);
  ASSERT_EQ(varied.code, 0) << varied.text;
  for (const char* kind : {"defaults.arcs", "defaults.flat_arcs"})
    experiment.profile.set(kind, "epsilon", "0.2");
  experiment.profile.write(experiment.out("changed.toml"));
  ASSERT_EQ(experiment.make_of("changed.toml", "changed", 1, "statistics").code, 0);

  // Every line and point once, every arc twice.
  EXPECT_THAT(made(varied), HasSubstr("layer2_n10/01"));
  EXPECT_THAT(made(varied), HasSubstr("short/layer3_n10/01"));
  EXPECT_THAT(made(varied), HasSubstr("short/flat_arcs/00"));
  EXPECT_THAT(made(varied), HasSubstr("short/arc_quality/00"));
  EXPECT_THAT(made(varied), HasSubstr("short/statistics.json"));
  for (const char* shared : {"short/layer1", "short/layer2", "short/reference4d", "short/accuracy"})
    EXPECT_THAT(made(varied), Not(HasSubstr(shared)));

  const auto before = experiment.artifacts("plain"), other = experiment.artifacts("changed"),
             both = experiment.artifacts("varied");
  int own = 0;
  for (const auto& [name, bytes] : other) {
    if (!name.ends_with(".h5")) continue;
    const bool is_own = both.contains("short/" + name);
    own += is_own;
    EXPECT_TRUE(both.at(is_own ? "short/" + name : name) == bytes) << name;
    EXPECT_TRUE(both.at(name) == before.at(name)) << name;
    EXPECT_EQ(before.at(name) == bytes, !is_own) << name;
  }
  EXPECT_EQ(own, 2 * (4 + 1 + 1 + 1));  // layer 3 and the flat arcs, and what is measured of them

  // The statistics are those of the changed profile under another name.
  std::string statistics = both.at("short/statistics.json");
  const std::string name = "varied/short";
  ASSERT_NE(statistics.find(name), std::string::npos);
  EXPECT_EQ(statistics.replace(statistics.find(name), name.size(), "tiny"), other.at("statistics.json"));

  const std::string page = both.at("page/index.html");
  EXPECT_THAT(page, HasSubstr("<section id=\"sensitivity\">"));
  EXPECT_THAT(page, HasSubstr("<code>short</code></dt><dd>Shorter.</dd>"));
  EXPECT_THAT(page, HasSubstr("class=\"same\""));  // of the lines
  EXPECT_THAT(before.at("page/index.html"), Not(HasSubstr("sensitivity\"")));
  EXPECT_EQ(made(experiment.make_of("varied.toml", "varied", 1)), "");

  // What is kept of it as a reference is what verifying finds again; another run is told from it.
  const std::string reference = HBR_BINARY_DIR "/bin/reference ", folder = experiment.out("kept").string();
  const auto call = [&](const std::string& task, const std::string& out) {
    return shell(reference + task + " " + experiment.out(out).string() + " " + folder);
  };
  EXPECT_THAT(call("verify", "varied").text, HasSubstr("there is no reference"));
  ASSERT_EQ(call("keep", "varied").code, 0);
  const ShellResult verified = call("verify", "varied");
  EXPECT_EQ(verified.code, 0) << verified.text;
  EXPECT_THAT(verified.text, HasSubstr("bit for bit: no difference"));
  fs::rename(experiment.out("kept/varied"), experiment.out("kept/tiny"));
  const ShellResult other_run = call("verify", "plain");
  EXPECT_EQ(other_run.code, 0) << other_run.text;
  EXPECT_THAT(other_run.text, HasSubstr("variation short: not in this run, not compared"));
  fs::rename(experiment.out("kept/tiny/short.statistics.json"), experiment.out("kept/tiny/statistics.json"));
  const ShellResult different = call("verify", "plain");
  EXPECT_EQ(different.code, 2);
  EXPECT_THAT(different.text, HasSubstr("different: layer3.n10.mean: "));

  // What changes in the base is no less a change.
  for (const char* kind : {"defaults.arcs", "defaults.flat_arcs"})
    experiment.profile.set(kind, "epsilon", "0.025");
  experiment.profile.set("arc_quality", "fresh_starts", "7");
  experiment.profile.write(experiment.out("profile.toml"));
  EXPECT_EQ(made(experiment.make_of("varied.toml", "varied", 1, "arc_quality short/arc_quality")),
            "arc_quality/00 arc_quality/01 short/arc_quality/00 short/arc_quality/01");
}

}  // namespace
}  // namespace hbr
