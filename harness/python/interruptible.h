// Long work that Python can interrupt.
#pragma once

#include <atomic>
#include <functional>

namespace photonproof::inline harness_python {

/// Runs `work` in a thread of its own. The calling thread has the GIL; it waits without it, and takes it every 20 ms to
/// serve Python's signals and to call `serve`. If one of them raises, `stop` becomes true, and the exception leaves
/// this function once the work has ended. Throws what `work` throws.
void run_interruptibly(std::atomic<bool>& stop, const std::function<void()>& work, const std::function<void()>& serve);

}  // namespace photonproof::inline harness_python
