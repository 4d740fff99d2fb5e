// The HDF5 library behind two rules: no return code is ignored, and after the first failed call on a file that is being
// written no further call is made on it.
//
// Why: when the disk is full, HDF5 1.10 reports a failure once and then closes the file "successfully", or crashes in
// its exit handler while it tries to write again what it could not write before.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>

#include "runner/store/store_error.h"

namespace seapile::store::hdf5 {

/// What a handle does when it is destroyed by an exception: what was opened for reading is closed, what was opened for
/// writing is left alone.
enum class OnError { close, abandon };

/// Throws a StoreError with the innermost reason that the library gives.
[[noreturn]] void fail(StoreError::Kind kind, const std::string& doing);

/// Switches off the library's own printing and its exit handler; to be called before anything else, as often as wanted.
void initialise();

/// An identifier of the library. It is closed by close(); one that is destroyed open, without an error on its way, is a
/// bug and ends the program.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// Takes over an identifier just returned; throws when it is none.
  Handle(hid_t id, Close how_to_close, OnError on_error, const std::string& doing);
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&&) = delete;
  ~Handle();

  hid_t get() const { return id_; }
  void close();

 private:
  hid_t id_;
  Close close_;
  OnError on_error_;
  StoreError::Kind kind_;
  std::string doing_;
  int exceptions_at_start_;
};

/// Throws when a call has failed.
inline void check(herr_t code, OnError on_error, const std::string& doing) {
  if (code < 0) fail(on_error == OnError::close ? StoreError::Kind::damaged : StoreError::Kind::io, doing);
}

}  // namespace seapile::store::hdf5
