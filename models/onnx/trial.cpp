#include "models/onnx/trial.h"

#include <fmt/ranges.h>

#include <numeric>

#include "pipeline/core/check.h"
#include "pipeline/core/json_text.h"
#include "pipeline/core/settings.h"

namespace hbr::inline onnx {

struct ToldShape {
  bool given = false;  // by OpenCV
  std::vector<int> sizes;
  bool floats = false;
};
template <class Fields>
void describe(Fields& f, ToldShape& s) {
  f.flag("given", s.given, "whether OpenCV gives the tensor");
  f.numbers("sizes", s.sizes, Range{0, 2147483647}, "of the tensor");
  f.flag("floats", s.floats, "whether these are its numbers");
}

struct ToldTrial {
  std::uint64_t hash = 0;
  std::vector<ToldShape> shapes;
};
template <class Fields>
void describe(Fields& f, ToldTrial& t) {
  f.number("hash", t.hash, Range{0, 2e19}, "of the tensors' numbers");
  f.tables("shapes", t.shapes, "one for each tensor that was asked for");
}

std::size_t TensorShape::numbers() const {
  return std::accumulate(sizes.begin(), sizes.end(), std::size_t{1},
                         [](std::size_t n, int size) { return n * static_cast<std::size_t>(size); });
}

std::string TensorShape::text() const { return fmt::format("{}", fmt::join(sizes, " x ")); }

std::string told(const Trial& trial, const std::vector<std::string>& tensors) {
  ToldTrial all{trial.hash, {}};
  for (const std::string& tensor : tensors) {
    const auto found = trial.shapes.find(tensor);
    all.shapes.push_back(found == trial.shapes.end()
                             ? ToldShape{}
                             : ToldShape{true, found->second.sizes, found->second.floats});
  }
  return settings_to_json(std::move(all)).dump();
}

Trial understood(const std::string& where, const std::string& text, const std::vector<std::string>& tensors) {
  const auto astray = [&](const std::string& why) {
    return InputError(
        "{}: a first run of it went astray ({}); the file is damaged, get it or export it again", where, why);
  };
  ToldTrial all;
  try {
    const std::string what = "what it said";
    all = settings_from_json<ToldTrial>(parse_json(text, what), what);
  } catch (const InputError& error) {
    throw astray(error.what());
  }
  if (all.shapes.size() != tensors.size())
    throw astray(fmt::format("expected {} shapes, found {}", tensors.size(), all.shapes.size()));
  Trial trial{{}, all.hash};
  for (std::size_t i = 0; i < tensors.size(); ++i)
    if (ToldShape& shape = all.shapes[i]; shape.given)
      trial.shapes[tensors[i]] = {std::move(shape.sizes), shape.floats};
  return trial;
}

}  // namespace hbr::inline onnx
