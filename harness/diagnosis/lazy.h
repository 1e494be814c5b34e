// A value that is made at its first use. Several threads may use it at once: one makes it, the others wait. An
// exception of its making is thrown in all of them.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace photonproof::inline harness_diagnosis {

template <class Value>
class Lazy {
 public:
  /// Uses the value's own constructor without arguments.
  Lazy() : Lazy(Value()) {}
  explicit Lazy(Value value) : state_(std::make_shared<State>()) {
    state_->make = [kept = std::move(value)]() mutable { return std::move(kept); };
  }
  explicit Lazy(std::function<Value()> make) : state_(std::make_shared<State>()) { state_->make = std::move(make); }

  const Value& get() const {
    State& state = *state_;
    std::call_once(state.once, [&] {
      try {
        state.value = state.make();
      } catch (...) {
        state.error = std::current_exception();
      }
      state.make = nullptr;
    });
    if (state.error) std::rethrow_exception(state.error);
    return state.value;
  }

 private:
  struct State {
    std::once_flag once;
    std::function<Value()> make;
    Value value;
    std::exception_ptr error;
  };
  std::shared_ptr<State> state_;  ///< shared by copies
};

}  // namespace photonproof::inline harness_diagnosis
