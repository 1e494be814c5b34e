// The passes of a render, with budget, progress, Ctrl-C and checkpoints around them. Every integrator runs its passes
// through it.
// ```
//   RenderLoop loop(job, threads, film, stats, {.phase = "path tracing"});
//   while (loop.next())
//     loop.for_each_tile([&](const Tile& tile) { ... samples [loop.first(), loop.first() + loop.samples()) ... });
// ```
// A checkpoint holds the film, the ray counts, the finished units of the current pass (tiles, or chunks of light paths)
// and the data passed to `keep`. It is copied between units, when none is in progress, so a pass may be longer than the
// time between checkpoints. The copy, as large as the film, is written while rendering continues.
// A preview of the image is made between units, too.
// A resumed render processes the remaining units. Their random numbers depend only on their indices, so it ends with
// the bits of an uninterrupted one.
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
  std::string phase;          ///< For the progress line.
  std::int64_t longest = 64;  ///< Most samples per pixel of a pass.
  std::int64_t parts = 1;     ///< A pass takes at most 1 / parts of all samples before it.
  /// The part of the budget that affects a pass's estimates; only a render of the same can be resumed. If empty, a
  /// render may be resumed with more samples, where the passes made so far are those of the longer render.
  std::string budget = {};
  /// Squared error common to all passes, as relmse counts it: beside the film's standard error. Empty: nothing.
  std::function<double()> squared_bias = {};
  /// The part of that which no number of passes changes, and its source. Empty: nothing. A render with a target error
  /// ends where the rest of its error is small beside this.
  std::function<double()> lasting_bias = {};
  std::function<std::string()> lasting_bias_of = {};
  /// Factor of the filter's negative lobes, which get samples of their own (negative_lobes.h); 0: none.
  double subtracted = 0;
  bool combines_passes = false;  ///< A pass is one estimate, and needs one of those samples at least.
};

class RenderLoop {
 public:
  RenderLoop(const RenderJob& job, const Threads& threads, Film& film, RenderStats& stats, PassPlan plan);
  RenderLoop(const RenderLoop&) = delete;
  RenderLoop& operator=(const RenderLoop&) = delete;

  // --- before the first pass: further content of checkpoints, of trivially copyable types ---

  /// Data that the units themselves change, one at a time (a second film, sums of commits).
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
  /// Data changed at the start of a pass, before its units (the number of photons emitted). It is restored to its value
  /// before that, since a resumed pass starts again, with the units left to do.
  template <class T>
  void keep_between_passes(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    between_.push_back({reinterpret_cast<char*>(&value), std::vector<char>(sizeof value)});
  }

  // --- the passes ---

  /// Begins the next pass. False when the budget is used up or the render was interrupted; then the stats are filled.
  /// The first call restores the checkpoint to continue from; it throws InputError when that is of another render.
  bool next();
  std::int64_t first() const { return schedule_.samples_done() - samples_; }  ///< first sample of the pass
  std::int64_t samples() const { return samples_; }                           ///< samples per pixel of the pass
  /// The pass's samples of the filter's negative lobes, which have a sequence of their own.
  std::int64_t first_negative() const { return first_negative_; }
  std::int64_t negative() const { return negative_; }

  /// Calls body(tile) for the film's tiles, on any thread, in any order: at most once per pass. The body may change
  /// only the film's pixels in its tile, and rays().
  void for_each_tile(const std::function<void(const Tile&)>& body);

  /// The same for `units` pieces of work with common results (light paths splat anywhere). The call body(unit, slot)
  /// runs in any order on any thread and stores its result in one of slots() slots. Then commit(unit, slot) runs for
  /// one unit after the other in their order. Only commit may add the result to the film or to kept data.
  void for_each_in_order(std::size_t units, const std::function<void(std::size_t unit, std::size_t slot)>& body,
                         const std::function<void(std::size_t unit, std::size_t slot)>& commit);
  std::size_t slots() const { return threads_.in_flight(); }
  /// Whether some units were not done, because the render is being stopped. Kept data must then stay unchanged.
  bool broken_off() const { return pass_is_open(); }

  /// Rays of the units, over the whole render. The integrator keeps the counts of rays between passes itself.
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
  /// Whether the film meets the budget's target error.
  bool reached_target();
  /// Relative error of the image's pixels; empty where the film does not have it.
  std::optional<double> error();
  /// Reports why the target was not reached, or, without a target, a large lasting bias.
  void say_what_lasts();
  /// Reports where the target was reached because radiances are far below epsilon.
  void say_if_dim();
  double fraction(double part) const;
  bool writes() const { return job_.checkpoint && job_.checkpoint->interval_seconds > 0; }
  bool checkpoint_is_due() const { return writes() && since_write_.seconds() >= job_.checkpoint->interval_seconds; }
  bool preview_is_due() const { return job_.preview && since_preview_.seconds() >= job_.preview_seconds; }
  /// Whether units wait for a pause.
  bool pause_is_due() const { return checkpoint_is_due() || preview_is_due(); }
  /// Writes the checkpoint and shows the preview that are due, while no unit is in progress.
  void pause();
  /// The first pass is always made whole, so that no pixel stays black.
  bool stops() const { return job_.interrupted() && first() > 0; }
  void begin_units(std::size_t count);
  bool pass_is_open() const { return units_done_ < done_.size(); }
  void unit_is_done(std::size_t unit);
  void write();
  void show();
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
  std::int64_t first_negative_ = 0, negative_ = 0;
  std::optional<double> error_;  ///< where it is the budget: after the last whole pass
  bool begun_ = false;
  bool resumed_pass_ = false;       ///< done_ was restored for this pass
  std::vector<std::uint8_t> done_;  ///< one per unit of the pass
  std::size_t units_done_ = 0;
  std::mutex progress_mutex_;
  Timer since_progress_, since_write_, since_preview_;
  struct Written {
    double seconds = 0;
    std::string problem;
  };
  FileClaim claim_;               ///< on this render's checkpoint
  std::string content_;           ///< of the checkpoint that is being written
  std::future<Written> writing_;  ///< the last member: its task ends before the members that it uses
};

}  // namespace photonproof::inline renderer_passes
