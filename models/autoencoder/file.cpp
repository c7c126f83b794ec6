#include "models/autoencoder/file.h"

#include <fmt/ranges.h>

#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::inline autoencoder {
namespace {

using net::Layer;

std::string kernel_name(const Layer& layer) { return "weights/" + layer.name + "/kernel"; }
std::string bias_name(const Layer& layer) { return "weights/" + layer.name + "/bias"; }

// Without the padding of rows.
void write_rows(Hdf5Writer& file, const std::string& name, const std::vector<std::size_t>& shape,
                const float* from, net::Index rows, net::Index columns, net::Index stride) {
  std::vector<float> values;
  for (net::Index r = 0; r < rows; ++r)
    values.insert(values.end(), from + r * stride, from + r * stride + columns);
  file.write(name, shape, values.data());
}

void read_rows(const Hdf5Reader& file, const std::string& name, const std::vector<std::size_t>& shape,
               float* to, net::Index columns, net::Index stride) {
  const Array<float> array = file.read<float>(name);
  if (array.shape != shape)
    throw InputError("{}: {}: expected the shape {}, found {}", file.path().string(), name,
                     fmt::join(shape, " x "), fmt::join(array.shape, " x "));
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    if (!std::isfinite(array.values[i]))
      throw InputError("{}: {}: entry {} is {}, expected a finite number", file.path().string(), name, i,
                       array.values[i]);
    const auto at = static_cast<net::Index>(i);
    to[at / columns * stride + at % columns] = array.values[i];
  }
}

double checked_attribute(const Hdf5Reader& file, const char* name, double low, double high) {
  const double value = file.number_attribute(name);
  if (!(value >= low && value <= high))
    throw InputError("{}: attribute {} is {}, expected {} to {}", file.path().string(), name, value, low,
                     high);
  return value;
}

// Whether an attribute is the second of two words.
bool is_second(const Hdf5Reader& file, const char* name, const char* first, const char* second) {
  const std::string value = file.text_attribute(name);
  if (value != first && value != second)
    throw InputError("{}: attribute {} is '{}', expected '{}' or '{}'", file.path().string(), name, value,
                     first, second);
  return value == second;
}

}  // namespace

void write_autoencoder(Hdf5Writer& file, const Autoencoder& autoencoder) {
  const net::Network& network = autoencoder.network();
  file.attribute("latent_size", static_cast<std::int64_t>(network.layout.latent_size));
  file.attribute("leak", static_cast<double>(network.activations.leak));
  file.attribute("hidden", std::string(network.activations.tanh_hidden ? "tanh" : "leaky"));
  file.attribute("output", std::string(network.activations.linear_output ? "linear" : "sigmoid"));
  for (const Layer& l : network.layout.layers) {
    const float* p = network.parameters.data();
    write_rows(file, kernel_name(l), l.shape, p + l.kernel, l.inputs, l.outputs, l.stride);
    write_rows(file, bias_name(l), {static_cast<std::size_t>(l.outputs)}, p + l.bias, 1, l.outputs,
               l.outputs);
  }
}

Autoencoder load_autoencoder(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const double latent = checked_attribute(file, "latent_size", 1, net::kMaxLatent);
  const net::Activations activations = {static_cast<float>(checked_attribute(file, "leak", 0, 1)),
                                        is_second(file, "hidden", "leaky", "tanh"),
                                        is_second(file, "output", "sigmoid", "linear")};
  net::Network network(static_cast<int>(latent), activations);
  for (const Layer& l : network.layout.layers) {
    float* p = network.parameters.data();
    read_rows(file, kernel_name(l), l.shape, p + l.kernel, l.outputs, l.stride);
    read_rows(file, bias_name(l), {static_cast<std::size_t>(l.outputs)}, p + l.bias, l.outputs, l.outputs);
  }
  network.refresh();
  return Autoencoder(std::move(network));
}

}  // namespace hbr::inline autoencoder
