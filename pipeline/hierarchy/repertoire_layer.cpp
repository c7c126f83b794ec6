#include "pipeline/hierarchy/repertoire_layer.h"

#include <limits>

#include "pipeline/core/check.h"
#include "pipeline/qd/nearest_table.h"

namespace hbr::inline hierarchy {
namespace {

template <int D>
class CellTable final : public CommandTable {
 public:
  CellTable(const Rows& rows, float low, float high) : table_(rows, low, high) {}
  void nearest(int n, const float* const* commands, std::int32_t* found) const override {
    std::array<const float*, D> coordinates;
    for (int d = 0; d < D; ++d) coordinates[d] = commands[d];
    table_.nearest(n, coordinates, found);
  }

 private:
  NearestTable<D> table_;
};

// Asks every row.
class PlainTable final : public CommandTable {
 public:
  explicit PlainTable(const Rows& rows) : rows_(rows) {}
  void nearest(int n, const float* const* commands, std::int32_t* found) const override {
    for (int i = 0; i < n; ++i) {
      float least = std::numeric_limits<float>::infinity();
      for (Eigen::Index row = 0; row < rows_.rows(); ++row) {
        float squared = 0;
        for (Eigen::Index d = 0; d < rows_.cols(); ++d)
          squared += (rows_(row, d) - commands[d][i]) * (rows_(row, d) - commands[d][i]);
        if (squared >= least) continue;
        least = squared;
        found[i] = static_cast<std::int32_t>(row);
      }
    }
  }

 private:
  Rows rows_;
};

}  // namespace

std::unique_ptr<CommandTable> make_command_table(const Rows& rows, float low, float high) {
  switch (rows.cols()) {
    case 1:
      return std::make_unique<CellTable<1>>(rows, low, high);
    case 2:
      return std::make_unique<CellTable<2>>(rows, low, high);
    case 3:
      return std::make_unique<CellTable<3>>(rows, low, high);
    default:
      return std::make_unique<PlainTable>(rows);
  }
}

RepertoireLayer::RepertoireLayer(const Elites& elites, const Decoder& decoder, const PointLayer& points,
                                 const Layer& below, float slack)
    : descriptors_(elites.measures),
      low_(elites.measures.minCoeff()),
      high_(elites.measures.maxCoeff()),
      slack_(slack) {
  plans_.make(decoder, points, below, elites.solution, elites.length.empty() ? nullptr : elites.length.data(),
              0, static_cast<int>(elites.size()));
}

void RepertoireLayer::nearest(int n, const float* const* commands, std::int32_t* elites) const {
  std::call_once(asked_, [&] { table_ = make_command_table(descriptors_, low_ - slack_, high_ + slack_); });
  table_->nearest(n, commands, elites);
}

}  // namespace hbr::inline hierarchy
