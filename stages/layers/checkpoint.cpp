#include "stages/layers/checkpoint.h"

#include <algorithm>
#include <numeric>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/artifact/temporary.h"
#include "pipeline/core/check.h"

namespace hbr::inline stages {

void write_checkpoint(const std::filesystem::path& path, const SearchState& state) {
  std::vector<std::int32_t> order(state.elites.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return state.elites.id[a] < state.elites.id[b]; });
  const Temporary unfinished(temporary_beside(path));
  Hdf5Writer file(unfinished.path);
  write_elites(file, in_order(state.elites, order), state.progress);
  file.write("slot", order);
  file.write("selector", state.selector);
  file.write("generation", std::vector<std::int64_t>{state.generation});
  file.close();
  std::filesystem::rename(unfinished.path, path);
}

bool can_resume(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return false;
  try {
    read_checkpoint(path);
    return true;
  } catch (const InputError& error) {
    fmt::print(stderr, "the search begins anew: {}\n", error.what());
    std::filesystem::remove(path);
    return false;
  }
}

SearchState read_checkpoint(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const Elites elites = read_elites(path);
  const std::vector<std::int32_t> slot = file.read<std::int32_t>("slot").values;
  const std::vector<std::int64_t> generation = file.read<std::int64_t>("generation").values;
  std::vector<std::int32_t> order(slot.size(), -1);
  for (std::size_t i = 0; i < slot.size(); ++i)
    if (slot[i] >= 0 && slot[i] < static_cast<std::int32_t>(order.size()))
      order[slot[i]] = static_cast<std::int32_t>(i);
  if (static_cast<Eigen::Index>(slot.size()) != elites.size() || generation.size() != 1 ||
      std::ranges::find(order, -1) != order.end())
    throw InputError("{}: a damaged checkpoint: expected a slot for each of {} elites and one generation",
                     path.string(), elites.size());
  return {generation[0], in_order(elites, order), file.read<std::int64_t>("selector").values,
          read_progress(path)};
}

}  // namespace hbr::inline stages
