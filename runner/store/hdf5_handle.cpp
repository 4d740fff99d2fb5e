#include "runner/store/hdf5_handle.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <utility>

namespace seapile::store::hdf5 {

namespace {

herr_t take_innermost(unsigned, const H5E_error2_t* error, void* reason) {
  auto& text = *static_cast<std::string*>(reason);
  if (text.empty() && error->desc != nullptr) text = error->desc;
  return 0;
}

}  // namespace

void fail(StoreError::Kind kind, const std::string& doing) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_innermost, &reason);
  throw StoreError(kind, "cannot " + doing + ": " + (reason.empty() ? "HDF5 gives no reason" : reason));
}

void initialise() {
  // The exit handler would close abandoned files, which is what they are abandoned for not to happen.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  // The printing is switched per thread. No file is to make us load a library that reads it.
  if (H5open() < 0 || H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) < 0 || H5PLset_loading_state(0) < 0) {
    throw StoreError(StoreError::Kind::io, "cannot initialise the HDF5 library");
  }
}

Handle::Handle(hid_t id, Close how_to_close, OnError on_error, const std::string& doing)
    : id_(id),
      close_(how_to_close),
      on_error_(on_error),
      kind_(on_error == OnError::close ? StoreError::Kind::damaged : StoreError::Kind::io),
      doing_(doing),
      exceptions_at_start_(std::uncaught_exceptions()) {
  if (id_ < 0) fail(kind_, doing_);
}

Handle::Handle(Handle&& other) noexcept
    : id_(std::exchange(other.id_, H5I_INVALID_HID)),
      close_(other.close_),
      on_error_(other.on_error_),
      kind_(other.kind_),
      doing_(std::move(other.doing_)),
      exceptions_at_start_(other.exceptions_at_start_) {}

Handle::~Handle() {
  if (id_ < 0) return;
  if (std::uncaught_exceptions() <= exceptions_at_start_) {
    std::fprintf(stderr, "Seapile: an HDF5 handle was not closed (%s)\n", doing_.c_str());
    std::abort();
  }
  if (on_error_ == OnError::close) close_(id_);
}

void Handle::close() {
  if (close_(std::exchange(id_, H5I_INVALID_HID)) < 0) fail(kind_, "close, after it was to " + doing_);
}

}  // namespace seapile::store::hdf5
