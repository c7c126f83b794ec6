#include "pipeline/hierarchy/plans.h"

#include <algorithm>

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/executions.h"

namespace hbr::inline hierarchy {

void Plans::make(const Decoder& decoder, const PointLayer& points, const Layer& below, const Rows& genomes,
                 const std::int32_t* lengths, Eigen::Index first, int n) {
  const int size = decoder.command_size();
  HBR_CHECK(size == below.command_size(), "commands of {} numbers for a layer that takes {}", size,
            below.command_size());
  below_ = &below;
  relative_ = decoder.relative();
  displaces_ = decoder.displaces();
  most_ = decoder.max_commands();
  even_ = true;
  count_.resize(n);
  commands_.resize(static_cast<std::size_t>(n) * most_ * size);
  placement_.clear();
  displaced_.assign(displaces_ ? static_cast<std::size_t>(n) * most_ : 0, Eigen::Vector2d::Zero());
  for (int i = 0; i < n; ++i) {
    const float* genome = genomes.row(first + i).data();
    const int length = lengths ? lengths[first + i] : static_cast<int>(genomes.cols());
    count_[i] = decoder.decode(genome, length, &commands_[static_cast<std::size_t>(i) * most_ * size]);
    even_ = even_ && count_[i] == most_;
    if (const auto placement = decoder.placement(genome)) placement_.push_back(*placement);
    if (displaces_)
      for (int k = 0; k < count_[i]; ++k) displaced_[i * most_ + k] = decoder.displacement(genome, k);
  }
  ask_below(points.frame(), size);
}

void Plans::ask_below(const Frame& frame, int size) {
  const int n = static_cast<int>(count_.size()) * most_;
  if (relative_) {
    move_.resize(n);
    for (auto& coordinate : step_) coordinate.resize(n);
    for (int i = 0; i < n; ++i) {
      move_[i] = {commands_[2 * i], commands_[2 * i + 1]};
      const Eigen::Vector2f step = frame.point_step(move_[i]);
      for (int d = 0; d < 2; ++d) step_[d][i] = step[d];
    }
    return;
  }
  // Commands that are not given are those of the last genome that gave them, or 0: nobody reads the answers.
  coordinates_.resize(static_cast<std::size_t>(n) * size);
  std::vector<const float*> coordinate(size);
  for (int d = 0; d < size; ++d) {
    float* const values = &coordinates_[static_cast<std::size_t>(d) * n];
    for (int i = 0; i < n; ++i) values[i] = static_cast<float>(commands_[i * size + d]);
    coordinate[d] = values;
  }
  elite_.resize(n);
  below_->nearest(n, coordinate.data(), elite_.data());
}

void Plans::perform(Executions& executions, Group group, const std::int32_t* which, int repeat) const {
  if (!placement_.empty())
    for (std::size_t i = 0; i < group.size(); ++i) {
      const PenPlacement& placement = placement_[which[i / repeat]];
      executions.put_down(group[i], placement.place, placement.width);
    }
  std::vector<std::int32_t> some, some_which;
  for (int k = 0; k < most_; ++k) {
    if (even_) {
      command(executions, group, which, repeat, k);
      continue;
    }
    some.clear();
    some_which.clear();
    for (std::size_t i = 0; i < group.size(); i += repeat)
      if (k < count_[which[i / repeat]]) {
        some.insert(some.end(), &group[i], &group[i] + repeat);
        some_which.push_back(which[i / repeat]);
      }
    if (!some.empty()) command(executions, some, some_which.data(), repeat, k);
  }
}

void Plans::command(Executions& executions, Group group, const std::int32_t* which, int repeat, int k) const {
  if (relative_) {
    executions.displace(group, {&move_[k], &step_[0][k], &step_[1][k], most_}, which, repeat);
    return;
  }
  std::vector<std::int32_t> elites(group.size() / repeat);
  for (std::size_t run = 0; run < elites.size(); ++run) elites[run] = elite_[which[run] * most_ + k];
  if (!displaces_) return below_->perform(executions, group, elites.data(), repeat);
  std::vector<Eigen::Vector2d> origins(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) {
    origins[i] = executions.origin(group[i]);
    executions.set_origin(group[i], origins[i] + displaced_[which[i / repeat] * most_ + k]);
  }
  below_->perform(executions, group, elites.data(), repeat);
  for (std::size_t i = 0; i < group.size(); ++i) executions.set_origin(group[i], origins[i]);
}

}  // namespace hbr::inline hierarchy
