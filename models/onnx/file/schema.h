// Field and enumeration numbers of onnx.proto (github.com/onnx/onnx), as many as are read or written here.
#pragma once

namespace hbr::inline onnx {

enum ModelField { kIrVersion = 1, kProducer = 2, kGraph = 7, kOperatorSets = 8, kMetadata = 14 };
enum GraphField {
  kNode = 1,
  kGraphName = 2,
  kInitializer = 5,
  kGraphDoc = 10,
  kInput = 11,
  kOutput = 12,
  kValueInfo = 13
};
enum NodeField {
  kNodeInput = 1,
  kNodeOutput = 2,
  kNodeName = 3,
  kOperation = 4,
  kAttribute = 5,
  kDomain = 7
};
enum AttributeField {
  kAttributeName = 1,
  kReal = 2,
  kInteger = 3,
  kText = 4,
  kTensor = 5,
  kIntegers = 8,
  kTensors = 10,
  kAttributeType = 20
};
enum AttributeType { kIsReal = 1, kIsInteger = 2, kIsText = 3, kIsIntegers = 7 };
enum TensorField {
  kDims = 1,
  kDataType = 2,
  kFloats = 4,
  kInt32s = 5,
  kInt64s = 7,
  kTensorName = 8,
  kRaw = 9,
  kDoubles = 10,
  kUint64s = 11,
  kExternalData = 13,
  kDataLocation = 14
};
enum DataType {
  kFloat = 1,
  kUint8 = 2,
  kInt8 = 3,
  kUint16 = 4,
  kInt16 = 5,
  kInt32 = 6,
  kInt64 = 7,
  kBool = 9,
  kFloat16 = 10,
  kDouble = 11,
  kUint32 = 12,
  kUint64 = 13,
  kBfloat16 = 16
};
// StringStringEntryProto, of external data and metadata.
enum EntryField { kKey = 1, kValue = 2 };
// ValueInfoProto { name, TypeProto { Tensor { element, TensorShapeProto { Dimension { value or name } } } } }
enum ValueField { kValueName = 1, kType = 2, kValueDoc = 3 };
enum TypeField { kTensorType = 1 };
enum TensorTypeField { kElement = 1, kShape = 2 };
enum ShapeField { kDimension = 1 };
enum DimensionField { kSize = 1, kSizeName = 2 };

}  // namespace hbr::inline onnx
