// A finished repertoire as a layer: the elite nearest to a command executes what its genome asks of the layer
// below.
#pragma once

#include <memory>
#include <mutex>

#include "pipeline/hierarchy/plans.h"

namespace hbr::inline hierarchy {

// Nearest rows for commands of any dimension.
class CommandTable {
 public:
  virtual ~CommandTable() = default;
  virtual void nearest(int n, const float* const* commands, std::int32_t* found) const = 0;
};
// Exact everywhere; in the box [low, high]^d it is fast for up to three dimensions, beyond that it asks every
// row.
std::unique_ptr<CommandTable> make_command_table(const Rows& rows, float low, float high);

class RepertoireLayer final : public Layer {
 public:
  // Commands are expected between the coordinates of the elites and up to `slack` beyond; others are answered
  // as well, more slowly.
  RepertoireLayer(const Elites& elites, const Decoder& decoder, const PointLayer& points, const Layer& below,
                  float slack);

  Eigen::Index size() const override { return descriptors_.rows(); }
  int command_size() const override { return static_cast<int>(descriptors_.cols()); }
  float low() const override { return low_; }
  float high() const override { return high_; }
  void nearest(int n, const float* const* commands, std::int32_t* elites) const override;
  void perform(Executions& executions, Group group, const std::int32_t* elites, int repeat) const override {
    plans_.perform(executions, group, elites, repeat);
  }

 private:
  Rows descriptors_;
  float low_, high_, slack_;
  Plans plans_;
  // Made when it is first asked: many a stack's top never is.
  mutable std::once_flag asked_;
  mutable std::unique_ptr<CommandTable> table_;
};

}  // namespace hbr::inline hierarchy
