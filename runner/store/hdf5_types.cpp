#include "runner/store/hdf5_types.h"

namespace seapile::store::hdf5 {

const char* name(Number number) {
  static constexpr const char* kNames[] = {"f64", "f32", "i32", "i64", "u64", "u8"};
  return kNames[static_cast<int>(number)];
}

hid_t type_of(Number number) {
  switch (number) {
    case Number::f64:
      return H5T_IEEE_F64LE;
    case Number::f32:
      return H5T_IEEE_F32LE;
    case Number::i32:
      return H5T_STD_I32LE;
    case Number::i64:
      return H5T_STD_I64LE;
    case Number::u64:
      return H5T_STD_U64LE;
    case Number::u8:
      return H5T_STD_U8LE;
  }
  return H5I_INVALID_HID;
}

std::size_t size_of(Number number) {
  switch (number) {
    case Number::f64:
    case Number::i64:
    case Number::u64:
      return 8;
    case Number::f32:
    case Number::i32:
      return 4;
    case Number::u8:
      return 1;
  }
  return 0;
}

}  // namespace seapile::store::hdf5
