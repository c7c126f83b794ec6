#include "models/onnx/trial.h"

#include <gmock/gmock.h>

#include <limits>

#include "pipeline/core/check.h"
#include "tests/support/damaged_json.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::vector<std::string> kTensors{"a", "b\xff", "c"};

// Of three tensors OpenCV gives two.
Trial some_trial() {
  return {{{"a", {{1, 2}, true}}, {"c", {{}, false}}}, std::numeric_limits<std::uint64_t>::max()};
}

// The line that refuses it, or what was understood.
std::string understanding_of(const std::string& text) {
  try {
    return told(understood("net.onnx", text, kTensors), kTensors);
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(OnnxTrial, ComesBackAsItWas) {
  const Trial trial = some_trial(), back = understood("net.onnx", told(trial, kTensors), kTensors);
  EXPECT_EQ(back.hash, trial.hash);
  ASSERT_EQ(back.shapes.size(), 2u);
  for (const auto& [name, shape] : trial.shapes) {
    EXPECT_EQ(back.shapes.at(name).sizes, shape.sizes);
    EXPECT_EQ(back.shapes.at(name).floats, shape.floats);
  }
}

TEST(OnnxTrial, ThatWentAstrayIsRefusedInOneLine) {
  const std::string good = told(some_trial(), kTensors);
  std::size_t refusals = 0;
  const std::vector<Damage> all = damages_of(good);
  for (const auto& [what, text] : all) {
    const std::string line = understanding_of(text);
    EXPECT_THAT(line, Not(HasSubstr("\n"))) << what;
    if (line.starts_with("{")) continue;  // another trial
    ++refusals;
    EXPECT_THAT(line, StartsWith("net.onnx: a first run of it went astray (")) << what;
    EXPECT_THAT(line, HasSubstr("; the file is damaged")) << what;
  }
  EXPECT_GT(refusals, 3 * all.size() / 4);
  EXPECT_THAT(understanding_of(""), HasSubstr("what it said: not JSON: at line 1"));
  EXPECT_THAT(understanding_of(R"({"shapes": []})"), HasSubstr("missing key 'hash'"));
  EXPECT_THAT(understanding_of(R"({"hash": 1, "shapes": []})"), HasSubstr("expected 3 shapes, found 0"));
  EXPECT_THAT(understanding_of(R"({"hash": 1, "shapes": [null, null, null]})"), HasSubstr("shapes.0"));
}

}  // namespace
}  // namespace hbr
