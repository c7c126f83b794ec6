#include "models/onnx/file/weights.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>

#include "models/onnx/file/fields.h"
#include "models/onnx/file/message.h"
#include "models/onnx/file/schema.h"
#include "models/onnx/file/shown.h"
#include "models/onnx/file/stored_tensor.h"
#include "pipeline/core/check.h"

namespace hbr::inline onnx {
namespace {

class Rewriter {
 public:
  // Reads weights that are elsewhere: so many bytes of those by this name.
  using Read = std::function<std::string(const ExternalData&, const std::string& name, std::uint64_t bytes)>;
  explicit Rewriter(Read read) : read_(std::move(read)) {}

  bool changed() const { return changed_; }

  Message model(std::string_view bytes) {
    Message out;
    Field f;
    for (FieldReader fields(bytes); fields.next(f);)
      f.number == onnx::kGraph ? out.message(f.number, graph(f.bytes)) : out.copy(f.whole);
    return out;
  }

 private:
  Message graph(std::string_view bytes) {
    Message out;
    Field f;
    for (FieldReader fields(bytes); fields.next(f);) switch (f.number) {
        case onnx::kNode:
          out.message(f.number, node(f.bytes));
          break;
        case onnx::kInitializer:
          out.message(f.number, tensor(f.bytes));
          break;
        case onnx::kInput:
        case onnx::kOutput:
        case onnx::kValueInfo:
          out.message(f.number, value(f.bytes));
          break;
        default:
          out.copy(f.whole);
      }
    return out;
  }

  Message node(std::string_view bytes) {
    Message out;
    bool casts = false;
    Field f;
    for (FieldReader fields(bytes); fields.next(f);)
      casts |= f.number == onnx::kOperation && f.bytes == "Cast";
    for (FieldReader fields(bytes); fields.next(f);)
      f.number == onnx::kAttribute ? out.message(f.number, attribute(f.bytes, casts)) : out.copy(f.whole);
    return out;
  }

  Message attribute(std::string_view bytes, bool casts) {
    Message out;
    Field f;
    for (FieldReader fields(bytes); fields.next(f);)
      if (f.number == onnx::kTensor || f.number == onnx::kTensors)
        out.message(f.number, tensor(f.bytes));
      else if (f.number == onnx::kInteger && casts)
        type(out, f);
      else
        out.copy(f.whole);
    return out;
  }

  // A data type: of a Cast, or of a value.
  void type(Message& out, const Field& f) {
    if (!is_converted(static_cast<std::int64_t>(f.value))) {
      out.copy(f.whole);
      return;
    }
    out.number(f.number, onnx::kFloat);
    changed_ = true;
  }

  Message value(std::string_view bytes) {
    return within(bytes, onnx::kType, [&](std::string_view types) {
      return within(types, onnx::kTensorType, [&](std::string_view tensor_type) {
        Message out;
        Field f;
        for (FieldReader fields(tensor_type); fields.next(f);)
          if (f.number == onnx::kElement)
            type(out, f);
          else
            out.copy(f.whole);
        return out;
      });
    });
  }

  template <class Rewrite>
  static Message within(std::string_view bytes, int number, Rewrite&& rewrite) {
    Message out;
    Field f;
    for (FieldReader fields(bytes); fields.next(f);)
      f.number == number ? out.message(number, rewrite(f.bytes)) : out.copy(f.whole);
    return out;
  }

  Message tensor(std::string_view bytes) {
    const StoredTensor t = read_tensor(bytes);
    if (!t.elsewhere && t.size() == 0) return Message().copy(bytes);  // texts and the like: not ours to judge
    if (t.size() == 0)
      throw InputError("its weights '{}' are of the type {} of onnx.proto, which is not read", shown(t.name),
                       t.type);
    std::string raw;
    if (t.elsewhere) {
      const std::uint64_t needed = t.count() * t.size();
      bytes_ += needed;
      if (bytes_ > kMaxWeightBytes) throw InputError("its weights are more than 2 GB");
      raw = read_(t.external, t.name, needed);
    } else {
      t.check_count();
      if (!is_converted(t.type)) return Message().copy(bytes);
      raw = t.unpacked();
    }
    changed_ = true;
    Message out = t.others;
    return is_converted(t.type)
               ? out.number(onnx::kDataType, onnx::kFloat).text(onnx::kRaw, to_floats(t.type, raw))
               : out.number(onnx::kDataType, t.type).text(onnx::kRaw, raw);
  }

  Read read_;
  std::uint64_t bytes_ = 0;  // that were elsewhere
  bool changed_ = false;
};

}  // namespace

std::string plain_weights(std::string_view model, const std::filesystem::path& file) {
  Rewriter rewriter([&](const ExternalData& data, const std::string& name, std::uint64_t bytes) {
    return data.read(file.parent_path(), name, bytes);
  });
  const Message plain = rewriter.model(model);
  return rewriter.changed() ? plain.bytes() : std::string(model);
}

std::vector<std::filesystem::path> weight_files(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> found;
  if (!std::filesystem::is_regular_file(file)) return found;  // likewise
  std::ifstream stream(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  Rewriter rewriter([&](const ExternalData& data, const std::string&, std::uint64_t) {
    const std::filesystem::path path = file.parent_path() / data.location;
    if (data.is_inside() && std::ranges::find(found, path) == found.end()) found.push_back(path);
    return std::string();
  });
  try {
    rewriter.model(content);
  } catch (const InputError&) {  // whoever reads it will say so
    return {};
  }
  return found;
}

}  // namespace hbr::inline onnx
