#include "pipeline/statistics/class_confusion.h"

#include <gmock/gmock.h>

#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "pipeline/statistics/collect.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

// Every point asked for its distance from every other.
ClassCounts by_brute_force(const std::vector<float>& position, const std::vector<std::uint8_t>& label,
                           std::size_t dimension) {
  ClassCounts counts{};
  for (std::size_t i = 0; i < label.size(); ++i) {
    double least = 1e300;
    std::size_t nearest = i;
    for (std::size_t j = 0; j < label.size(); ++j) {
      double square = 0;
      for (std::size_t d = 0; d < dimension; ++d) {
        const double gap = position[i * dimension + d] - position[j * dimension + d];
        square += gap * gap;
      }
      if (i != j && square < least) least = square, nearest = j;
    }
    counts[label[i]][label[nearest]] += 1;
  }
  return counts;
}

// On few places, so that many points are equally near, and on many.
TEST(ClassConfusion, AgainstBruteForce) {
  Rng rng(Seed(1));
  for (const std::size_t dimension : {1u, 2u, 3u})
    for (const std::uint32_t places : {4u, 1000000u}) {
      std::vector<std::uint8_t> label;
      std::vector<float> position;
      for (int i = 0; i < 200; ++i) {
        label.push_back(static_cast<std::uint8_t>(rng.below(10)));
        for (std::size_t d = 0; d < dimension; ++d) position.push_back(static_cast<float>(rng.below(places)));
      }
      EXPECT_EQ(nearest_classes(position, label), by_brute_force(position, label, dimension))
          << dimension << " " << places;
    }
}

TEST(ClassConfusion, RefusesWhatDoesNotFitTogether) {
  const std::vector<float> position{0, 1, 2, 3};
  EXPECT_THROW(nearest_classes(position, std::vector<std::uint8_t>{1, 2, 3}), InputError);
  EXPECT_THROW(nearest_classes(position, std::vector<std::uint8_t>{1}), InputError);
  EXPECT_THROW(nearest_classes(position, std::vector<std::uint8_t>{1, 10}), InputError);
}

// Ten classes on a line, pairs of points of class c at 10 c; of class c the share c / 10 has a neighbour of
// the next class instead.
class Confusion : public testing::Test {
 protected:
  // Good digits of class c: goods[c].
  nlohmann::json numbers(const std::vector<int>& goods, const std::vector<double>& kept) {
    const std::filesystem::path network = folder_.path() / "network.h5", verdicts = folder_.path() / "d.h5";
    Hdf5Writer file(network);
    std::vector<float> position;
    std::vector<std::uint8_t> label;
    for (int c = 0; c < 10; ++c)
      for (int k = 0; k < 10; ++k) {
        const float at = static_cast<float>(1000 * c + 10 * k);
        position.insert(position.end(), {at, at + 1});
        label.push_back(static_cast<std::uint8_t>(c));
        // Of a pair of two classes both are confused: pairs with the class after it, k < c of them.
        label.push_back(static_cast<std::uint8_t>(k < c ? (c + 1) % 10 : c));
      }
    // And 3s beside pairs of 5s, which do not lie beside 3s.
    for (int k = 0; k < 20; ++k)
      for (const auto& [shift, c] : {std::pair{0.0f, 3}, {2.0f, 5}, {3.0f, 5}}) {
        position.push_back(20000 + 10 * static_cast<float>(k) + shift);
        label.push_back(static_cast<std::uint8_t>(c));
      }
    file.write("training/epoch", std::vector<std::int64_t>{1});
    file.write("training/samples", std::vector<std::int64_t>{8});
    file.write("training/train_error", std::vector<double>{.4});
    file.write("training/tested", std::vector<std::int64_t>{1});
    file.write("training/test_error", std::vector<double>{.4});
    file.write("training/kept_per_class", kept);
    file.write("latent/position", {position.size(), 1}, position.data());
    file.write("latent/label", label);
    file.close();
    Hdf5Writer digits(verdicts);
    std::vector<std::uint8_t> of, good;
    for (std::size_t c = 0; c < 10; ++c)
      for (int i = 0; i <= goods[c]; ++i) {
        of.push_back(static_cast<std::uint8_t>(c));
        good.push_back(i < goods[c] ? 1 : 0);  // and one more that is not good
      }
    const std::size_t n = of.size();
    digits.write("hbr/image", Array<std::uint8_t>{{n, 28, 28}, std::vector<std::uint8_t>(784 * n)});
    digits.write("hbr/measures", Array<float>{{n, 2}, std::vector<float>(2 * n)});
    for (const char* array : {"objective", "confidence", "distance"})
      digits.write(std::string("hbr/") + array, std::vector<float>(n, 0.5f));
    digits.write("hbr/label", of);
    digits.write("hbr/good", good);
    digits.close();
    return collect_statistics("tiny", {{"autoencoder/00.h5", network}, {"digit_verdicts/00.h5", verdicts}});
  }
  TemporaryFolder folder_;
};

TEST_F(Confusion, OfClassesAndHowRareTheyAre) {
  const std::vector<double> kept{1, .9, .8, .7, .6, .5, .4, .3, .2, .1};
  const nlohmann::json found = numbers({9, 8, 7, 6, 5, 4, 3, 2, 1, 0}, kept);
  // Class c has 10 + (10 - c) points of its own blocks, c of the first kind confused, and c - 1 among those
  // of the class before it, all confused.
  for (int c = 0; c < 10; ++c) {
    const double strangers = c == 0 ? 9 : c - 1, confused = c + strangers + (c == 3 ? 20 : 0),
                 all = 20 - c + strangers +
                       (c == 3   ? 20
                        : c == 5 ? 40
                                 : 0);
    EXPECT_NEAR(
        found["quantities"]["autoencoder.confused_of_class." + std::to_string(c)]["median"].get<double>(),
        confused / all, 1e-12)
        << c;
    // Most often the class after it, but for 0, which lies among 9s, and 3.
    EXPECT_EQ(found["numbers"]["autoencoder.taken_for." + std::to_string(c)]["value"], c == 0 ? 9
                                                                                       : c == 3
                                                                                           ? 5
                                                                                           : (c + 1) % 10);
  }
  const auto number = [](const nlohmann::json& of, const std::string& name) {
    return of["numbers"]["digit_verdicts.hbr." + name]["value"].get<double>();
  };
  EXPECT_NEAR(number(found, "good_if_cut"), -1, 1e-12);
  EXPECT_NEAR(number(found, "good_if_cut_low"), -1, 1e-12);
  EXPECT_NEAR(number(found, "good_if_cut_high"), -1, 1e-12);
  EXPECT_LT(number(found, "good_if_confused"), -0.5);
  EXPECT_NEAR(number(numbers({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, kept), "good_if_cut"), 1, 1e-12);
  EXPECT_THROW(numbers({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {1}), InputError);
}

}  // namespace
}  // namespace hbr
