// What a stretch of steps hands out, until it is accepted.
#pragma once

#include <functional>
#include <utility>
#include <vector>

namespace seapile::simulation {

class HeldBack {
 public:
  /// Hands out `what` when the stretch is accepted, in the order of the calls. `hook`: may be empty.
  template <class T>
  void add(const std::function<void(const T&)>& hook, T what) {
    if (hook) waiting_.push_back([&hook, held = std::move(what)] { hook(held); });
  }
  void release() {
    for (const auto& hand_out : std::exchange(waiting_, {})) hand_out();
  }
  void drop() { waiting_.clear(); }

 private:
  std::vector<std::function<void()>> waiting_;
};

}  // namespace seapile::simulation
