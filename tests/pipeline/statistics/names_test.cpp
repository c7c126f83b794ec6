#include "pipeline/statistics/names.h"

#include <gtest/gtest.h>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

TEST(ArtifactName, HasHeadVariantAndReplication) {
  struct Case {
    const char *name, *head, *variant;
    int replication;
  };
  for (const Case& c :
       {Case{"layer2_n10/03.h5", "layer2", "n10", 3}, Case{"layer1/00.h5", "layer1", "", 0},
        Case{"layer1_substitute/12.h5", "layer1", "substitute", 12},
        Case{"nao_layer1/01.h5", "layer1", "nao", 1}, Case{"nao_transfer/07.h5", "transfer", "nao", 7},
        Case{"nao_dynamics/07.h5", "dynamics", "nao", 7},
        Case{"layer2_n10_short/00.h5", "layer2", "n10_short", 0},
        Case{"flat_digits/09.h5", "flat_digits", "", 9}, Case{"judge.h5", "judge", "", -1},
        Case{"nao_projected/01.h5", "projected", "nao", 1},
        Case{"nao_left_tuned/02.h5", "tuned", "nao_left", 2},
        Case{"nao_tuned_lines/02.h5", "tuned_lines", "nao", 2},
        Case{"arm_tuned_top/02.h5", "tuned_top", "arm", 2}, Case{"nao_plane.h5", "plane", "nao", -1}}) {
    const ArtifactName parsed = parse_artifact_name(c.name);
    EXPECT_EQ(parsed.head, c.head) << c.name;
    EXPECT_EQ(parsed.variant, c.variant) << c.name;
    EXPECT_EQ(parsed.replication, c.replication) << c.name;
  }
}

TEST(ArtifactName, OfTheProfilesOwnLayersIsTheirs) {
  const ArtifactName own = parse_artifact_name("spirals/04.h5", {"spirals", "layer1"});
  EXPECT_EQ(own.prefix(), "layers.spirals");
  EXPECT_EQ(own.replication, 4);
  EXPECT_EQ(parse_artifact_name("layer1/04.h5", {"spirals", "layer1"}).prefix(), "layer1");
  EXPECT_THROW(parse_artifact_name("spiral/04.h5", {"spirals"}), InputError);
  EXPECT_EQ(meaning_of("layers.spirals.size")->text, "layer, spirals: elites in the repertoire");
}

TEST(ArtifactName, RefusesOtherNames) {
  for (const char* name :
       {"", "layer5/00.h5", "layer2/first.h5", "layer2_n1.0/00.h5", "report", "layer1/.h5"})
    EXPECT_THROW(parse_artifact_name(name), InputError) << name;
}

TEST(Meaning, KnowsTheVocabularyAndNothingElse) {
  for (const char* name : {"layer2.n10.size",
                           "layer1.size",
                           "reference4d.size",
                           "layer3.b.fresh_mean",
                           "flat_arcs.equal_mean",
                           "accuracy.reference_endpoint",
                           "substitution.m3.substitute",
                           "transfer.nao.absolute_median",
                           "dynamics.nao.arm_rms",
                           "dynamics.nao.whole_torque_of.LHipPitch",
                           "dynamics.nao.duration",
                           "numbers.values",
                           "numbers.nao.legible",
                           "tuned.arm.top.good_gain",
                           "tuned.nao.all.arc_centre_from_arm",
                           "digit_verdicts.hbr.good_of_class.4",
                           "digit_verdicts.hbr.good_if_confused",
                           "digit_verdicts.flat.good_if_cut_high",
                           "digit_turns.hbr.joints",
                           "digit_turns.flat.refused_turn_more_low",
                           "digit_turns.flat_turn_more_high",
                           "layer3.n100.replaced",
                           "autoencoder.kept_of_class.2",
                           "autoencoder.confused_of_class.4",
                           "autoencoder.taken_for.4",
                           "judge.test_accuracy",
                           "layer4.generations",
                           "genes.hierarchy"}) {
    const auto meaning = meaning_of(name);
    ASSERT_TRUE(meaning) << name;
    EXPECT_EQ(meaning->text.find("{}"), std::string::npos);
  }
  for (const char* name : {"", "layer2", "layer2.n10.sizes", "layer5.size", "layer2..size", "layer2.a.b.size",
                           "substitution.m4.original", "transfer.absolute", "dynamics.nao.leg_rms",
                           "dynamics.nao.arm_rms.LHipPitch", "digit_verdicts.hbr.good_of_class.x",
                           "digit_verdicts.hbr.good_low", "digit_turns.hbr.turn_low", "digit_turns.turn",
                           "autoencoder.taken_for.x", "judge.accuracy", "accuracy"})
    EXPECT_FALSE(meaning_of(name)) << name;
}

TEST(Meaning, SpeaksOfTheVariant) {
  EXPECT_EQ(meaning_of("layer2.n10.size")->text, "layer 2 (lines), N = 10: elites in the repertoire");
  EXPECT_EQ(meaning_of("layer3.b.mean")->text, "layer 3 (arcs), controller B: mean fitness");
  EXPECT_EQ(meaning_of("accuracy.n10_short")->unit, "m^2");
}

}  // namespace
}  // namespace hbr
