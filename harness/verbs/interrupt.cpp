#include "harness/verbs/interrupt.h"

#include <csignal>

namespace photonproof::inline harness_verbs {
namespace {

// A signal handler has no parameter to reach anything else through.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "only a lock-free flag may be set in a signal handler");

void on_signal(int) { interrupted = true; }

bool install() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  // RESETHAND: the second one is fatal. RESTART: code that does not know of signals sees no EINTR; poll always does.
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return true;
}

}  // namespace

const std::atomic<bool>& interrupt_flag() {
  [[maybe_unused]] static const bool installed = install();
  return interrupted;
}

}  // namespace photonproof::inline harness_verbs
