#include "pipeline/core/random.h"

#include "pipeline/core/check.h"

namespace hbr::inline core {
namespace {

using Philox = r123::Philox4x32;

Philox::key_type split(std::uint64_t key) {
  return {{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}};
}

// The domains keep a name, an index and a stream of the same node apart.
enum Domain : std::uint32_t { kStream = 0, kIndex = 1, kName = 2 };

std::uint64_t mix(std::uint64_t key, Domain domain, std::uint64_t value) {
  const Philox::ctr_type counter = {
      {static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(value >> 32), 0, domain}};
  const auto block = Philox()(counter, split(key));
  return block[0] | (static_cast<std::uint64_t>(block[1]) << 32);
}

}  // namespace

Seed Seed::child(std::string_view name) const {
  // The name is absorbed eight bytes at a time, then its length: no two names share their blocks.
  std::uint64_t key = key_;
  for (std::size_t begin = 0; begin < name.size(); begin += 8) {
    std::uint64_t word = 0;
    for (const char c : name.substr(begin, 8)) word = (word << 8) | static_cast<unsigned char>(c);
    key = mix(key, kName, word);
  }
  return Seed(mix(key, kName, name.size()));
}

Seed Seed::child(std::uint64_t index) const { return Seed(mix(key_, kIndex, index)); }

Rng::Rng(Seed seed) : key_(split(seed.key())) {}

void Rng::refill() {
  const Philox::ctr_type counter = {
      {static_cast<std::uint32_t>(counter_), static_cast<std::uint32_t>(counter_ >> 32), 0, kStream}};
  block_ = Philox()(counter, key_);
  ++counter_;
  used_ = 0;
}

double Rng::uniform_double() {
  const std::uint64_t high = bits();
  const std::uint64_t word = (high << 32) | bits();
  return static_cast<double>(word >> 11) * 0x1p-53;
}

std::uint32_t Rng::below(std::uint32_t n) {
  HBR_CHECK(n > 0, "n = {}", n);
  std::uint64_t product = static_cast<std::uint64_t>(bits()) * n;
  if (static_cast<std::uint32_t>(product) < n) {
    const std::uint32_t rejected = (0u - n) % n;
    while (static_cast<std::uint32_t>(product) < rejected) product = static_cast<std::uint64_t>(bits()) * n;
  }
  return static_cast<std::uint32_t>(product >> 32);
}

}  // namespace hbr::inline core
