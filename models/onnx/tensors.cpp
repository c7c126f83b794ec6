#include "models/onnx/tensors.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "models/onnx/file/flow.h"
#include "models/onnx/file/schema.h"
#include "models/onnx/file/shown.h"
#include "models/onnx/file/stored_tensor.h"
#include "pipeline/core/check.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/qd/dimension.h"

namespace hbr::inline onnx {
namespace {

using Shapes = std::map<std::string, TensorShape>;

std::vector<std::string> names_of(const std::vector<OnnxValue>& values) {
  std::vector<std::string> names;
  for (const OnnxValue& value : values) names.push_back(value.name);
  return names;
}

std::vector<FlowTensor> flow_to(const OnnxModel& model, const std::vector<std::string>& ends) {
  return flow(model, model.inputs.front().name, ends);
}

std::vector<std::string> made_of_the_image(const OnnxModel& model, std::vector<std::string> ends) {
  for (const OnnxNode& node : model.nodes) ends.insert(ends.end(), node.outputs.begin(), node.outputs.end());
  std::vector<std::string> names;
  for (const FlowTensor& tensor : flow_to(model, ends)) names.push_back(tensor.name);
  return names;
}

void check_named(const OnnxModel& model, const char* key, const std::string& name) {
  if (name.empty()) return;
  const std::vector<std::string> known = made_of_the_image(model, {});
  if (std::ranges::count(known, name)) return;
  const auto node = std::ranges::find(model.nodes, name, &OnnxNode::name);
  if (node != model.nodes.end())
    throw InputError("{} = '{}' is the name of a node; expected that of a tensor: it makes '{}'", key,
                     shown(name), shown(node->first_output()));
  std::vector<std::string> outputs;
  for (const std::string& output : names_of(model.outputs)) outputs.push_back(shown(output));
  throw InputError("{} = '{}': no tensor of this name is made of the image{}; its outputs are {}", key,
                   shown(name), did_you_mean(name, known), fmt::join(outputs, ", "));
}

bool is_narrow(const TensorShape& shape) {
  return shape.floats && shape.numbers() >= 1 && shape.numbers() <= kMaxDescriptorSize;
}

// "'mu' (1 x 2, an output)"
std::string listed(const std::string& name, const Shapes& shapes, const std::string& what) {
  return fmt::format("'{}' ({}{})", shown(name), shapes.at(name).text(), what);
}

// Gives each coordinate of a tensor a value of its own: what comes out is the same place, told otherwise.
bool is_elementwise(const OnnxNode& node) {
  constexpr std::array<std::string_view, 31> kOperations{"Identity",
                                                         "Dropout",
                                                         "Cast",
                                                         "Reshape",
                                                         "Flatten",
                                                         "Squeeze",
                                                         "Unsqueeze",
                                                         "Transpose",
                                                         "Relu",
                                                         "PRelu",
                                                         "LeakyRelu",
                                                         "Elu",
                                                         "Selu",
                                                         "Celu",
                                                         "Tanh",
                                                         "Sigmoid",
                                                         "Softplus",
                                                         "Gelu",
                                                         "HardSigmoid",
                                                         "Clip",
                                                         "Softsign",
                                                         "Add",
                                                         "Sub",
                                                         "Mul",
                                                         "Div",
                                                         "Neg",
                                                         "Sqrt",
                                                         "Pow",
                                                         "Exp",
                                                         "HardSwish",
                                                         "BatchNormalization"};
  return std::ranges::find(kOperations, node.operation) != kOperations.end();
}

class Choice {
 public:
  Choice(const OnnxModel& model, Shapes shapes, const OnnxSettings& settings)
      : model_(model), shapes_(std::move(shapes)), settings_(settings) {
    // OpenCV gives integers, such as the number of a class, as floats, too; the file says what they are.
    for (const OnnxValue& output : model.outputs)
      if (const auto found = shapes_.find(output.name); found != shapes_.end())
        found->second.floats &= output.type == onnx::kFloat || is_converted(output.type) || output.type == 0;
  }

  std::string reconstruction() const {
    if (!settings_.reconstruction.empty()) {
      const TensorShape& shape = named("reconstruction", settings_.reconstruction);
      if (shape.numbers() != kImagePixels)
        throw InputError("reconstruction = '{}' has {} numbers an image ({}); expected 784",
                         shown(settings_.reconstruction), shape.numbers(), shape.text());
      return settings_.reconstruction;
    }
    std::vector<std::string> images, all;
    for (const std::string& output : outputs()) {
      all.push_back(listed(output, shapes_, ""));
      if (shapes_.at(output).numbers() == kImagePixels && shapes_.at(output).floats) images.push_back(output);
    }
    if (images.size() != 1)
      throw InputError("expected one output of 784 numbers an image, found outputs of {}{}",
                       fmt::join(all, ", "),
                       images.empty() ? "" : "; name the reconstruction in the profile");
    return images.front();
  }

  std::string position(const std::string& reconstruction) const {
    if (!settings_.position.empty()) {
      const TensorShape& shape = named("position", settings_.position);
      if (!is_narrow(shape))
        throw InputError("position = '{}' has {} numbers an image ({}); expected 1 to {}",
                         shown(settings_.position), shape.numbers(), shape.text(), kMaxDescriptorSize);
      return settings_.position;
    }
    std::vector<std::string> narrow_outputs;
    for (const std::string& output : outputs())
      if (is_narrow(shapes_.at(output)) && output != reconstruction) narrow_outputs.push_back(output);
    const std::vector<FlowTensor> way = way_to(reconstruction);
    if (narrow_outputs.size() > 1) refuse(narrow_outputs, way);
    if (narrow_outputs.empty()) return narrowest(way, reconstruction);
    const std::string& output = narrow_outputs.front();
    std::vector<std::string> candidates = codes(way);
    if (candidates.empty() || is_only_way(way, output)) return output;
    candidates.push_back(output);
    refuse(candidates, way);
  }

 private:
  std::vector<std::string> outputs() const {
    std::vector<std::string> names = names_of(model_.outputs);
    std::erase_if(names, [&](const std::string& name) { return !shapes_.contains(name); });
    return names;
  }

  const TensorShape& named(const char* key, const std::string& name) const {
    const auto found = shapes_.find(name);
    if (found == shapes_.end())
      throw InputError(
          "{} = '{}': OpenCV fuses the nodes around it and does not give it; name another tensor", key,
          shown(name));
    if (!found->second.floats) throw InputError("{} = '{}' is not of type float32", key, shown(name));
    return found->second;
  }

  // The tensors with a shape on the way from the image to the reconstruction, without the latter.
  std::vector<FlowTensor> way_to(const std::string& reconstruction) const {
    std::vector<FlowTensor> way = flow_to(model_, {reconstruction});
    std::erase_if(way, [&](const FlowTensor& t) {
      const auto found = shapes_.find(t.name);
      return t.name == reconstruction || found == shapes_.end() || !found->second.floats;
    });
    return way;
  }

  static bool is_only_way(const std::vector<FlowTensor>& way, const std::string& name) {
    return std::ranges::any_of(way, [&](const FlowTensor& t) { return t.name == name && t.only_way; });
  }

  std::size_t numbers(const FlowTensor& tensor) const { return shapes_.at(tensor.name).numbers(); }

  // Whether all nodes from one tensor to a later one leave coordinates to themselves.
  bool same_place(const FlowTensor& first, const FlowTensor& later) const {
    const std::vector<FlowTensor> between = flow_to(model_, {later.name});
    return std::ranges::all_of(between, [&](const FlowTensor& t) {
      return t.node <= first.node || is_elementwise(model_.nodes[t.node]);
    });
  }

  // The narrowest tensors that all passes through, those that are the same place given by their last.
  std::vector<std::string> codes(const std::vector<FlowTensor>& way) const {
    std::vector<FlowTensor> narrowest;
    for (const FlowTensor& tensor : way) {
      if (!tensor.only_way || !is_narrow(shapes_.at(tensor.name))) continue;
      if (!narrowest.empty() && numbers(tensor) < numbers(narrowest.front())) narrowest.clear();
      if (narrowest.empty() || numbers(tensor) == numbers(narrowest.front())) narrowest.push_back(tensor);
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < narrowest.size(); ++i)
      if (i + 1 == narrowest.size() || !same_place(narrowest[i], narrowest[i + 1]))
        names.push_back(narrowest[i].name);
    return names;
  }

  std::string narrowest(const std::vector<FlowTensor>& way, const std::string& reconstruction) const {
    std::vector<std::string> candidates = codes(way);
    // Tensors beside the only way that are as narrow; not those within a place, such as a gate of it.
    for (const FlowTensor& tensor : way) {
      if (tensor.only_way || !is_narrow(shapes_.at(tensor.name)) || is_within_a_place(way, tensor)) continue;
      if (candidates.empty() || numbers(tensor) <= shapes_.at(candidates.front()).numbers())
        candidates.push_back(tensor.name);
    }
    if (candidates.size() == 1 && is_only_way(way, candidates.front())) return candidates.front();
    if (candidates.empty()) refuse_wide(way, reconstruction);
    refuse(candidates, way);
  }

  // Between two tensors of its size that all passes through and that are the same place.
  bool is_within_a_place(const std::vector<FlowTensor>& way, const FlowTensor& tensor) const {
    const FlowTensor *before = nullptr, *after = nullptr;
    for (const FlowTensor& t : way) {
      if (!t.only_way) continue;
      if (t.node < tensor.node) before = &t;
      if (t.node > tensor.node && !after) after = &t;
    }
    return before && after && numbers(*before) == numbers(*after) && same_place(*before, *after);
  }

  [[noreturn]] void refuse_wide(const std::vector<FlowTensor>& way, const std::string& reconstruction) const {
    const FlowTensor* narrowest = nullptr;
    for (const FlowTensor& tensor : way)
      if (tensor.only_way && (!narrowest || numbers(tensor) <= numbers(*narrowest))) narrowest = &tensor;
    if (narrowest)
      throw InputError("its narrowest layer, '{}', has {} numbers an image; expected 1 to {} as position",
                       shown(narrowest->name), numbers(*narrowest), kMaxDescriptorSize);
    throw InputError(
        "no tensor of 1 to {} numbers an image lies on the way to the reconstruction '{}'; "
        "expected one as position",
        kMaxDescriptorSize, shown(reconstruction));
  }

  [[noreturn]] void refuse(std::vector<std::string> names, const std::vector<FlowTensor>& way) const {
    constexpr std::size_t kMost = 12;
    std::stable_partition(names.begin(), names.end(),
                          [&](const std::string& name) { return is_only_way(way, name); });
    std::vector<std::string> candidates;
    for (const std::string& name : names) {
      std::string what;
      if (std::ranges::count(outputs(), name)) what += ", an output";
      if (is_only_way(way, name)) what += ", all of the reconstruction passes through it";
      candidates.push_back(listed(name, shapes_, what));
    }
    std::string more;
    if (candidates.size() > kMost) {
      more = fmt::format(" and {} more", candidates.size() - kMost);
      candidates.resize(kMost);
    }
    throw InputError(
        "which tensor is the position is not clear: {}{}; name it in the profile, as in position "
        "= '{}' of [descriptor.onnx]",
        fmt::join(candidates, ", "), more, shown(names.front()));
  }

  const OnnxModel& model_;
  Shapes shapes_;
  const OnnxSettings& settings_;
};

}  // namespace

std::vector<std::string> tensors_to_try(const OnnxModel& model, const OnnxSettings& settings) {
  check_named(model, "position", settings.position);
  check_named(model, "reconstruction", settings.reconstruction);
  if (!settings.position.empty() && !settings.reconstruction.empty())
    return {settings.position, settings.reconstruction};
  std::vector<std::string> ends = names_of(model.outputs), names;
  for (const std::string& named : {settings.position, settings.reconstruction})
    if (!named.empty()) ends.push_back(named);
  for (const FlowTensor& tensor : flow_to(model, ends)) names.push_back(tensor.name);
  if (names.empty()) throw InputError("none of its outputs depends on the image");
  return names;
}

ChosenTensors choose_tensors(const OnnxModel& model, const Shapes& shapes, const OnnxSettings& settings) {
  const Choice choice(model, shapes, settings);
  const std::string reconstruction = choice.reconstruction();
  return {choice.position(reconstruction), reconstruction};
}

}  // namespace hbr::inline onnx
