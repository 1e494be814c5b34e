// The passes of a render, and all that must not be lost or left undone around them: budget, progress, Ctrl-C,
// checkpoints. Every integrator runs its passes through it:
//
//   RenderLoop loop(job, threads, film, stats, {.phase = "path tracing"});
//   while (loop.next())
//     loop.for_each_tile([&](const Tile& tile) { ... samples [loop.first(), loop.first() + loop.samples()) ... });
//
// A checkpoint holds the film, the rays counted, which units of the current pass (tiles, or chunks of light paths) are
// done, and what the integrator asks to `keep`. It is copied between units, when none is being worked on, so a pass may
// be longer than the time between checkpoints; the copy, as large as the film, is written while rendering goes on. A
// render that is resumed does the units that were not done, from random numbers that depend on nothing but their
// indices, and so ends with the bits of one that was never stopped.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/checkpoint.h"
#include "renderer/core/parallel.h"
#include "renderer/passes/pass_schedule.h"
#include "renderer/passes/ray_totals.h"
#include "renderer/passes/render_job.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_passes {

struct PassPlan {
  std::string phase;          ///< for the progress line
  std::int64_t longest = 64;  ///< samples a pixel of a pass, at most
  std::int64_t parts = 1;     ///< of all samples before it a pass takes no more than one part of so many
  /// What else of the budget decides a pass's estimates; only a render of the same can be resumed. Without it a render
  /// may be resumed with more samples, where the passes made so far are those of the longer render.
  std::string budget = {};
  /// What all passes have wrong alike, squared, as relmse counts it: beside the film's standard error. Empty: nothing.
  std::function<double()> squared_bias = {};
  /// The part of that which no number of passes changes, and whose it is. Empty: nothing. A render that is to go on
  /// until its error is as asked ends where the rest of its error is small beside this.
  std::function<double()> lasting_bias = {};
  std::function<std::string()> lasting_bias_of = {};
};

class RenderLoop {
 public:
  RenderLoop(const RenderJob& job, const Threads& threads, Film& film, RenderStats& stats, PassPlan plan);
  RenderLoop(const RenderLoop&) = delete;
  RenderLoop& operator=(const RenderLoop&) = delete;

  // --- before the first pass: what checkpoints hold besides, of trivially copyable types ---

  /// Changed by the units themselves, one at a time (a second film, what commits sum up).
  void keep(Film& film);
  template <class T>
  void keep(T& value) {
    kept_.push_back(
        {[&value](StateWriter& out) { out.value(value); }, [&value](StateReader& in) { value = in.value<T>(); }});
  }
  template <class T>
  void keep(std::atomic<T>& value) {
    kept_.push_back({[&value](StateWriter& out) { out.value(value.load()); },
                     [&value](StateReader& in) { value = in.value<T>(); }});
  }
  template <class T>
  void keep(std::vector<T>& values) {
    kept_.push_back(
        {[&values](StateWriter& out) { out.vector(values); }, [&values](StateReader& in) { in.vector(values); }});
  }
  /// Changed at the start of a pass, before its units (how many photons were emitted). Restored as it was before that,
  /// since a pass that is resumed starts again, with the units left to do.
  template <class T>
  void keep_between_passes(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    between_.push_back({reinterpret_cast<char*>(&value), std::vector<char>(sizeof value)});
  }

  // --- the passes ---

  /// Begins the next pass. False when the budget is used up or the render was interrupted; then the stats are filled.
  /// The first call restores the checkpoint to go on from; it throws InputError when that is not one of this render.
  bool next();
  std::int64_t first() const { return schedule_.samples_done() - samples_; }  ///< sample of the pass
  std::int64_t samples() const { return samples_; }                           ///< a pixel, of the pass

  /// Calls body(tile) for the film's tiles, on any thread, in any order: at most once a pass. The body adds to the
  /// film's pixels in its tile, to rays(), and to nothing else.
  void for_each_tile(const std::function<void(const Tile&)>& body);

  /// The same for `units` pieces of work whose results meet (light paths splat anywhere): body(unit, slot) in any order
  /// on any thread leaves its result in a slot, of which there are slots(); commit(unit, slot) is called for one unit
  /// after the other in their order and adds it to the film or to what is kept. What is added may only be added there.
  void for_each_in_order(std::size_t units, const std::function<void(std::size_t unit, std::size_t slot)>& body,
                         const std::function<void(std::size_t unit, std::size_t slot)>& commit);
  std::size_t slots() const { return threads_.in_flight(); }
  /// After the units: some were not done, since the render is being stopped. What is kept must stay as they left it.
  bool broken_off() const { return pass_is_open(); }

  /// Of the units, over the whole render. Rays traced between passes are the integrator's to keep.
  RayTotals& rays() { return rays_; }

 private:
  struct Kept {
    std::function<void(StateWriter&)> save;
    std::function<void(StateReader&)> restore;
  };
  struct KeptBetween {
    char* data;
    std::vector<char> at_start;
  };

  /// Waits for the checkpoint that is being written.
  void finish_write();
  /// Whether the film is as good as the budget asks.
  bool reached_target();
  /// Relative, of the image's pixels; empty where the film does not know it.
  std::optional<double> error();
  /// Says why the target was not reached, or, where none was given, that much is wrong for good.
  void say_what_lasts();
  /// Says where the target was reached because radiances are far below epsilon.
  void say_if_dim();
  double fraction(double part) const;
  bool writes() const { return job_.checkpoint && job_.checkpoint->interval_seconds > 0; }
  bool due() const { return writes() && since_write_.seconds() >= job_.checkpoint->interval_seconds; }
  /// The first pass is always made whole, so that no pixel stays black.
  bool stops() const { return job_.interrupted() && first() > 0; }
  void begin_units(std::size_t count);
  bool pass_is_open() const { return units_done_ < done_.size(); }
  void unit_is_done(std::size_t unit);
  void write();
  void save(StateWriter& out) const;
  void restore(StateReader& in);
  bool ended(bool interrupted);

  const RenderJob& job_;
  const Threads& threads_;
  Film& film_;
  RenderStats& stats_;
  PassPlan plan_;
  PassSchedule schedule_;
  RayTotals rays_;
  std::vector<Kept> kept_;
  std::vector<KeptBetween> between_;
  std::int64_t samples_ = 0;
  std::optional<double> error_;  ///< where it is the budget: after the last whole pass
  bool begun_ = false;
  bool resumed_pass_ = false;       ///< done_ was restored for this pass
  std::vector<std::uint8_t> done_;  ///< a unit of the pass
  std::size_t units_done_ = 0;
  std::mutex progress_mutex_;
  Timer since_progress_, since_write_;
  struct Written {
    double seconds = 0;
    std::string problem;
  };
  FileClaim claim_;               ///< on the checkpoint that is this render's
  std::string content_;           ///< of the checkpoint that is being written
  std::future<Written> writing_;  ///< the last member: it ends before what it uses
};

}  // namespace photonproof::inline renderer_passes
