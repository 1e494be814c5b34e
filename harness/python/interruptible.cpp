#include "harness/python/interruptible.h"

#include <nanobind/nanobind.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace nb = nanobind;

namespace photonproof::inline harness_python {
namespace {

constexpr std::chrono::milliseconds between_signals{20};

/// Work in a thread of its own, and the exception that ended it.
class Worker {
 public:
  explicit Worker(const std::function<void()>& work) : thread_([this, &work] { run(work); }) {}

  /// True once the work has ended.
  bool wait() {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, between_signals, [this] { return done_; });
  }
  void join() { thread_.join(); }
  std::exception_ptr error() const { return error_; }

 private:
  void run(const std::function<void()>& work) {
    try {
      work();
    } catch (...) {
      error_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    done_ = true;
    ended_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace

void run_interruptibly(std::atomic<bool>& stop, const std::function<void()>& work, const std::function<void()>& serve) {
  Worker worker(work);
  std::exception_ptr raised;  // by Python
  for (bool done = false; !done && !raised;) {
    {
      const nb::gil_scoped_release released;
      done = worker.wait();
    }
    try {
      if (PyErr_CheckSignals() != 0) nb::raise_python_error();
      serve();
    } catch (...) {
      raised = std::current_exception();
      stop = true;
    }
  }
  {
    const nb::gil_scoped_release released;
    worker.join();
  }
  if (raised) std::rethrow_exception(raised);
  if (worker.error()) std::rethrow_exception(worker.error());
}

}  // namespace photonproof::inline harness_python
