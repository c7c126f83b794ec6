#include "models/onnx/file/flow.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

namespace hbr::inline onnx {
namespace {

bool reads_shapes_only(const OnnxNode& node) {
  constexpr std::array<std::string_view, 5> kOperations{"Shape", "Size", "EyeLike", "RandomNormalLike",
                                                        "RandomUniformLike"};
  return std::ranges::find(kOperations, node.operation) != kOperations.end();
}

bool any_of(const std::vector<std::string>& names, const std::set<std::string>& set) {
  return std::ranges::any_of(names, [&](const std::string& name) { return set.contains(name); });
}

}  // namespace

std::vector<FlowTensor> flow(const OnnxModel& model, const std::string& input,
                             const std::vector<std::string>& ends) {
  std::set<std::string> dependent{input};
  std::vector<bool> carries(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const OnnxNode& node = model.nodes[i];
    carries[i] = !reads_shapes_only(node) && any_of(node.inputs, dependent);
    if (!carries[i]) continue;
    for (const std::string& output : node.outputs)
      if (!output.empty()) dependent.insert(output);
  }
  std::set<std::string> leading(ends.begin(), ends.end());
  std::map<std::string, std::size_t> last_use;  // the last node on the way that reads it
  for (std::size_t i = model.nodes.size(); i-- > 0;) {
    const OnnxNode& node = model.nodes[i];
    carries[i] = carries[i] && any_of(node.outputs, leading);
    if (!carries[i]) continue;
    leading.insert(node.inputs.begin(), node.inputs.end());
    for (const std::string& name : node.inputs) last_use.try_emplace(name, i);
  }
  std::vector<FlowTensor> tensors;
  std::size_t read_until = last_use.contains(input) ? last_use.at(input) : 0;  // of what was made so far
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!carries[i]) continue;
    const std::size_t before = read_until;
    std::size_t made = 0;
    for (const std::string& name : model.nodes[i].outputs) {
      if (!leading.contains(name) || name.empty()) continue;
      tensors.push_back({name, i, before <= i});
      if (last_use.contains(name)) read_until = std::max(read_until, last_use.at(name));
      ++made;
    }
    if (made > 1)
      for (auto t = tensors.end() - static_cast<std::ptrdiff_t>(made); t != tensors.end(); ++t)
        t->only_way = false;
  }
  return tensors;
}

}  // namespace hbr::inline onnx
